"""Modules shared by components and analyses: paths, errors, files, archives, progress, processes."""

if __name__ == "common":  # would create a second copy of every class, whose errors would not be caught
    raise ImportError("common is a subpackage of perilune: import perilune.common")
