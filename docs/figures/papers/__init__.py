"""Figures of papers, drawn from our own numbers."""
