"""Hand-written three-dimensional scenes, and their content in a page."""
