"""Three-dimensional scene that a system declares."""
