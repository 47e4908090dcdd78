"""What a system, an FMU or a slot is, as plain values that print and leave as JSON."""
