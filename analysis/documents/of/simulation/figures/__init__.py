"""Figures that a system declares, as nodes of a document."""
