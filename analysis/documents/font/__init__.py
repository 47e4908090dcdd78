"""Font metrics for the width of text in figures."""
