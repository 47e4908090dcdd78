"""Scenes of three dimensions, made by hand, and what a page has of them."""
