"""Transfers between hovers. Kernel functions."""
