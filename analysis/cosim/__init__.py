"""Co-simulation of SSP systems: read and check, schedule, run, record."""
