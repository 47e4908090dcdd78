"""A simulation as a document: figures of its system, trajectories, histories, limits, final values."""
