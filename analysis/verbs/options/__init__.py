"""The declarations of verbs and options, from which command line, Python signatures, commands and records derive."""
