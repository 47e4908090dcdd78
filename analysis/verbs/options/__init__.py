"""Declarations that need higher rooms: the verbs of design, the list of all verbs, completion in a shell."""
