"""Whether flights show that a required share of them keeps a requirement: statistics on counts and columns."""
