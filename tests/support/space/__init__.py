"""Shared code of tests of a spacecraft and its environment."""
