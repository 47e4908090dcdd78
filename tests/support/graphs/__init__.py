"""Systems drawn at random from small blocks."""
