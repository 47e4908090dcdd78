"""Verbs and options as declarations, from which command line, Python signatures, commands and records derive."""
