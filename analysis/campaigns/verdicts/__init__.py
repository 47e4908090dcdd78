"""Evidence by flights for a required share of them to keep a requirement: statistics on counts and columns."""
