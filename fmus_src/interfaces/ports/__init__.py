"""Ports by domain."""
