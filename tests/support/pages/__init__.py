"""Pages: properties of every page, results to draw, a browser."""
