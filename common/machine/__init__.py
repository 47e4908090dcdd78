"""Limits of the machine: a cache that cannot be used, errors of the operating system, memory."""
