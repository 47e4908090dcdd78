"""The figures that a system declares, as nodes of a document."""
