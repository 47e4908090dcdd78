"""Comparison with Basilisk's Monte Carlo controller: the same samples, guidance and end condition."""
