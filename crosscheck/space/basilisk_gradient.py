"""The torque of the gravity gradient in Basilisk. Runs in Basilisk's environment."""

from Basilisk.simulation import GravityGradientEffector

from crosscheck.basilisk_side import Flight


def add_gravity_gradient(flight: Flight, planet: str = "centre") -> None:
    """Let the gravity gradient of a planet, by default of `Flight.attract`, act on the craft."""
    gradient = GravityGradientEffector.GravityGradientEffector()
    gradient.addPlanetName(planet)
    flight.craft.addDynamicEffector(gradient)
    flight.add(gradient)
    flight.kept.append(gradient)
