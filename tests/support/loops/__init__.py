"""Loops known exactly, and studies of them."""
