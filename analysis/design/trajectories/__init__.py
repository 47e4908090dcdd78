"""Plans of least propellant: the simplified programme of a hover transfer, its true optimum, bounds."""
