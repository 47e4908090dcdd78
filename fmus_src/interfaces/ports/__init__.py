"""Ports by domain: what is connected, declared once."""
