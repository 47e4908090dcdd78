"""Placing poles by formula: state and output feedback, observers, pulses. Pure mathematics, free of FMI."""
