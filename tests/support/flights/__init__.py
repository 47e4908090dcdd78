"""Flights flown without the project: independent integrations, and what blocks are flown with."""
