"""Documents of design: transfers, bounds, laws and searches, with their figures."""
