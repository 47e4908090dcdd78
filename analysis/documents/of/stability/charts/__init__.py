"""Charts of a stability study."""
