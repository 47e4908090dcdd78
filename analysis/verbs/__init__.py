"""The verbs: one file each, with the Python function that the command line calls, too."""
