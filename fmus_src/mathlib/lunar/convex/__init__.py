"""Powered descent of least propellant as a second-order cone programme, solved on board by an interior-point method."""
