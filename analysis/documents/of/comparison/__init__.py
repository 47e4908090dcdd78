"""The page that compares variants."""
