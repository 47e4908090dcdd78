"""Gains as symbolic formulas by sympy: multilevel decomposition, generalised Ackermann and Bass-Gura formulas."""
