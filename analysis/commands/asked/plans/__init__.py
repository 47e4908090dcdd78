"""The options of each plan of `perilune plan`."""
