"""Outputs of `perilune export`: FMUs, systems with their FMUs inside, the blocks of a file."""
