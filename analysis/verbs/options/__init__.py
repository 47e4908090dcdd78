"""Declarations that need higher layers: the verbs of design, the list of all verbs, completion in a shell."""
