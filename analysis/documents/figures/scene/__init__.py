"""A scene of three dimensions that a system declares."""
