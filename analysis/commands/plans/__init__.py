"""The plans of `perilune plan`, one a file."""
