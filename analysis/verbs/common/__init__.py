"""Shared by verbs: text of a flight, requirements, remarks on a system."""
