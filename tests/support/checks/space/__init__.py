"""Space environment in numpy, from the published series and tables, for the truths of several blocks."""
