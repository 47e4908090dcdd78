"""Pole placement by derivative feedback, under constant disturbances, and by output feedback through upper levels."""
