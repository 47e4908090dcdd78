"""Rotations, and what turns. Kernel functions."""
