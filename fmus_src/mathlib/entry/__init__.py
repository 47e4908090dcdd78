"""Entry into the atmosphere. Kernel functions."""
