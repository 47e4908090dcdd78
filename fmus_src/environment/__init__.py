"""Environment of a flight, by itself: what surrounds a spacecraft."""
