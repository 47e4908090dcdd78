"""Placing poles from measured outputs alone, u = F y."""
