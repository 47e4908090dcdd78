"""Document of a simulation: figures of its system, trajectories, histories, limits, final values."""
