"""Processes that end when the process that started them ends, even if it crashes or is killed."""
