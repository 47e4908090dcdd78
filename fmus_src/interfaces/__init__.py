"""Ports, and interfaces that only declare variables; an interface with computations is defined in the folder of its
blocks.
"""
