"""Outputs of `perilune export`: FMUs, systems packed with their FMUs, and the blocks of a file."""
