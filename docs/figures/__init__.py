"""Simulations for the demonstration and for the figures of the documentation."""
