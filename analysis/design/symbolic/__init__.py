"""Gains as formulas in symbols: the multilevel decomposition, generalised Ackermann and Bass-Gura formulas by sympy."""
