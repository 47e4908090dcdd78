"""Documents of results, one file per result."""
