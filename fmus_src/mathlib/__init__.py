"""Kernel functions shared by blocks."""
