"""Ports, and slots that only declare them; a base that computes stands with its blocks."""
