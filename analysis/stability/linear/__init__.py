"""Linearisation: the linear model over one hyperperiod from the memory of the FMUs."""
