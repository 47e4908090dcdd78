"""Diagrams of loops: what is drawn in axes, free of the page."""
