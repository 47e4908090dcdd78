"""Guidance laws, interchangeable behind their interface."""
