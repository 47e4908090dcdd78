"""Filters and inertial navigation. Kernel functions."""
