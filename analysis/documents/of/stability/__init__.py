"""Document of a stability study."""
