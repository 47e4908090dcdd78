"""Processes that others start, which end with those, however these end."""
