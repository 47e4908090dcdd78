"""Plants: vehicles and their motion."""
