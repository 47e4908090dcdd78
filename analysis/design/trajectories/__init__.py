"""Trajectories of least propellant: direct method, and lower bounds for transfers and landings."""
