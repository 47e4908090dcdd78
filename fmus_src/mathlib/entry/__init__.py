"""Atmospheric entry. Kernel functions."""
