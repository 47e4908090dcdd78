"""Declarations of verbs and options; command line, Python signatures, printed commands and records derive from them."""
