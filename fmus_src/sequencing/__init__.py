"""Sequencing: transitions between flight phases and modes."""
