"""Calls of a component's FMU, written as instructions: for FMI 2.0 and FMI 3.0 by the same methods."""
