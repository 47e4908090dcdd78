"""Counts of the project's own text: its size, its repetitions and its words. `python -m tests.house --help`."""
