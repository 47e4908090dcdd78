"""Forces and torques of the surroundings on a craft of Basilisk. Runs in Basilisk's environment."""

from collections.abc import Iterable
from types import ModuleType

import numpy as np
from Basilisk.simulation import GravityGradientEffector, facetDragDynamicEffector, facetSRPDynamicEffector

from crosscheck.basilisk_side import Flight, column, to_mrp


def drag_plates(plates: Iterable[Iterable[float]]) -> object:
    """Return the effector of drag on plates: area, normal, centre, drag coefficient, two reflectivities, body."""
    effector = facetDragDynamicEffector.FacetDragDynamicEffector()
    for area, nx, ny, nz, x, y, z, coefficient, *_ in plates:
        effector.addFacet(area, coefficient, column((nx, ny, nz)), column((x, y, z)))
    return effector


def sunlit_plates(plates: Iterable[Iterable[float]]) -> object:
    """Return the effector of solar pressure on the same plates."""
    effector = facetSRPDynamicEffector.FacetSRPDynamicEffector()
    rows = list(plates)
    effector.setNumFacets(len(rows))
    effector.setNumArticulatedFacets(0)
    for area, nx, ny, nz, x, y, z, _, specular, diffuse in rows:
        still = column((0.0, 0.0, 0.0))
        effector.addFacet(area, np.eye(3).tolist(), column((nx, ny, nz)), still, column((x, y, z)), diffuse, specular)
    return effector


def begin_in_gradient(case: ModuleType, step: float) -> Flight:
    """Return the flight of a rigid craft about a point mass, under its gravity gradient, as a case has it."""
    flight = Flight(step)
    flight.attract(case.MU)
    flight.set_inertia([list(row) for row in case.INERTIA], case.MASS)
    flight.start(case.START, case.SPEED, to_mrp(case.QUATERNION), case.ANGULAR_VELOCITY)
    gradient = GravityGradientEffector.GravityGradientEffector()
    gradient.addPlanetName("centre")
    flight.craft.addDynamicEffector(gradient)
    flight.add(gradient)
    flight.references.append(gradient)
    return flight
