"""Descent laws with engine limits, independent of the blocks (profiles, turns, steering), and descents."""
