"""Results on disk from Python."""
