"""Models shared by plants, observers and regulators."""
