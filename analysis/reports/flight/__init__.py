"""The page of one flight."""
