"""FMUs with arrays, and descriptions in SSP 2.0."""
