"""Analyses of components and systems: co-simulation, campaigns, reports and the command line."""

if __name__ == "analysis":  # would load a second copy of every class, and its errors would not be caught
    raise ImportError("analysis is a subpackage of perilune: import perilune.analysis")
