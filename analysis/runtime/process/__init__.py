"""Simulations in other processes: foreign FMUs are instantiated only there."""
