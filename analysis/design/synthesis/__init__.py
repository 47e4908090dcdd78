"""Synthesis of control laws: search for network operators by a variational genetic algorithm."""
