"""Co-simulation master: reads, resolves and simulates a system."""
