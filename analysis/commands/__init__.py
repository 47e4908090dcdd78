"""The verbs of the command line, one file each: `add` declares a verb's options, `run` carries it out."""
