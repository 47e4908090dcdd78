"""Disturbances of the environment and faults of actuators."""
