"""Documents of design: transfers, bounds, laws and searches for them, with their figures."""
