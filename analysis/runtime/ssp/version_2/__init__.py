"""Conversion of SSP 1.0 documents to SSP 2.0: a single connector, connection and list of values for each array."""
