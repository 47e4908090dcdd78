"""Document of a batch."""
