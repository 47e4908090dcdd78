"""Figures that a system declares for its runs."""
