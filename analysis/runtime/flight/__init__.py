"""Simulation of a system in this process: instances of FMUs, instructions, memory, faults, results."""
