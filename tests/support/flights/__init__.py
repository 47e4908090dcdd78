"""Trajectories independent of the project, and simulations of single blocks."""
