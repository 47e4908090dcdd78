"""Declared variables of FMUs, in one vocabulary for FMI 2.0 and FMI 3.0."""
