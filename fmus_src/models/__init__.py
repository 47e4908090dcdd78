"""Models shared by plants, observers and controllers."""
