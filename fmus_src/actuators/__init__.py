"""Allocation of commands to engines and attitude."""
