"""Transfers between points of hover. Kernel functions."""
