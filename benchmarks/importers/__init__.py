"""Time per communication step of Perilune's loop and of other importers, on the same FMUs in one run."""
