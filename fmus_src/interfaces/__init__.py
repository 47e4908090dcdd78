"""Ports, and interfaces that only declare variables; interfaces with computations are in the folders of their
blocks.
"""
