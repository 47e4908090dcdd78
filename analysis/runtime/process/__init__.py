"""Simulations in other processes, the only ones in which foreign FMUs are instantiated."""
