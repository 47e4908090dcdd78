"""The verbs, one per file: Python functions that the command line calls as well."""
