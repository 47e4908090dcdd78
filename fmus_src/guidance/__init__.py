"""Guidance laws; the laws of one slot are interchangeable."""
