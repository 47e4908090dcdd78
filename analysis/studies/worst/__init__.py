"""Worst cases: the draws of a box that make a number largest."""
