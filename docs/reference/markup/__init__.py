"""Markup of the site: equations, docstrings of blocks, links to blocks, formulas."""
