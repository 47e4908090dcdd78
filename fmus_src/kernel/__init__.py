"""Kernel language: its types and elementary functions."""
