"""Verbs that need no name of a higher room; those of design, and the list of all, are in `verbs/options`."""
