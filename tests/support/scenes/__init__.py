"""Hand-written scenes of three dimensions, and their content in a page."""
