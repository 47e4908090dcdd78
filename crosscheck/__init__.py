"""Cross-checks against Basilisk: the same flight in both, each in an environment of its own, compared by tables."""
