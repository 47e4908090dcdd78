"""Cost of the plant `spacecraft`, alone and in a system."""
