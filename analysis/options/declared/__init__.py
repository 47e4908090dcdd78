"""Verbs that need no names of higher layers; those of design, and the list of all verbs, are in `verbs/options`."""
