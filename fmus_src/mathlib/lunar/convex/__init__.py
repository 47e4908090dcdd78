"""Powered descent of least propellant as a second-order cone problem, solved on board by an interior-point method."""
