"""Figures of guidance laws on the same flight."""
