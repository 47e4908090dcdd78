"""Ports, one module for each domain."""
