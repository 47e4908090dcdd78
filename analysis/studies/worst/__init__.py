"""Worst cases: the draws in a box that maximise a number."""
