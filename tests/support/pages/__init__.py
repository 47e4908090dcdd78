"""Pages: what each must satisfy, results to draw, a browser."""
