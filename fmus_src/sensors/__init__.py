"""Sensors: measurements of the vehicle's motion and environment."""
