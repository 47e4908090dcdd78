"""Plans of least propellant: direct method, bounds of transfers and landings."""
