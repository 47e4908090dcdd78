"""Simulations of the demonstration and of the figures of the documentation."""
