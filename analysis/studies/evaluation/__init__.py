"""Flights of draws that a study chooses: who flies them, and what has been flown."""
