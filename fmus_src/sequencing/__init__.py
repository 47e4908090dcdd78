"""Transitions between phases of flight."""
