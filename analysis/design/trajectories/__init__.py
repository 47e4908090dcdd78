"""Plans of least propellant: direct method, and bounds of transfers and landings."""
