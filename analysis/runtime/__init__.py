"""The co-simulation master: a system is read, resolved and simulated."""
