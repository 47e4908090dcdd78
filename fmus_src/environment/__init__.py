"""Environment of a spacecraft as a separate block."""
