"""The verbs of the command line, one file each: `run` carries a verb out; `add` of `asked` declares its options."""
