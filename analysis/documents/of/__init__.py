"""Documents of the results, one file a result."""
