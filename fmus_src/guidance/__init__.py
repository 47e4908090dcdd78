"""Guidance laws, interchangeable within their slots."""
