"""Figures that compare guidance laws on the same landing."""
