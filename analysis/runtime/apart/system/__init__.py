"""Calls of the operating system for processes; Linux alone has most of them."""
