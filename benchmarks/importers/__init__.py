"""Times a communication step of this project's loop and of other importers, on the same FMUs in one run."""
