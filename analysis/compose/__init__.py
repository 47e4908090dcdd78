"""Systems composed from a short file, `system.toml`, and the way back."""
