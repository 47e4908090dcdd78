"""Figures of pages compared with their pictures in a browser."""
