"""Pole placement by formula: state and output feedback, observers, pulses. Pure mathematics, independent of FMI."""
