"""Conversion of SSP 1.0 documents to SSP 2.0: one connector, one connection and one list of values for an array."""
