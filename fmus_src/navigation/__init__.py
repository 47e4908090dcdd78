"""Estimates of the vehicle's state for guidance and control."""
