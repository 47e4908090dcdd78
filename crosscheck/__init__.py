"""Cross-checks against Basilisk: the same flight in both, each in a separate environment, compared by tables."""
