"""Perilune's components, one Python class each, and what turns them into FMUs."""
