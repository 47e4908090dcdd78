"""Document that compares variants."""
