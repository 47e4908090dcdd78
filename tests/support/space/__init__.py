"""Shared code of tests of a spacecraft and of its environment."""
