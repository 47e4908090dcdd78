"""Design: pole placement, trajectories, control laws and their synthesis."""
