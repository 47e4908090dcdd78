"""Time per communication step of Perilune's loop and of other importers, with the same FMUs, in one run."""
