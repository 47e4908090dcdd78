"""Vehicles and their motion."""
