"""Declarations of verbs that depend on no higher layer; `verbs/options` has the verbs of design and the list of all."""
