"""Simulation loop in C: its instructions, arrays and library; elementary functions of arrays."""
