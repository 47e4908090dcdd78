"""Simulations in another process: foreign FMUs are instantiated there, and never in this one."""
