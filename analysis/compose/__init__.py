"""Composition of systems from a short file, `system.toml`, and the conversion of an SSD to such a file."""
