"""Rotations and rotating directions. Kernel functions."""
