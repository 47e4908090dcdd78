"""Measurements of the vehicle's motion."""
