"""Kernel functions that several blocks share."""
