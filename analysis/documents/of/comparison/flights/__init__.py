"""Recorded simulations of a comparison: paths, quantities over time, final errors."""
