"""Ports, and slots that only declare variables; slots with computations are defined next to their blocks."""
