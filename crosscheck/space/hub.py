"""The hub that is left of a whole without its moving masses. Needs numpy alone."""

from collections.abc import Iterable

import numpy as np


def steiner(mass: float, place: np.ndarray) -> np.ndarray:
    """Return the inertia (kg m2) of a point mass (kg) at a place (m) about the origin."""
    return mass * (place @ place * np.eye(3) - np.outer(place, place))


def hub_of(
    mass: float, inertia: object, moving: Iterable[tuple[float, np.ndarray, np.ndarray]]
) -> tuple[float, np.ndarray, np.ndarray]:
    """Return mass (kg), place of the centre of mass (m) and inertia about it (kg m2) of the hub.

    ``mass`` and ``inertia`` are those of the whole, whose centre of mass is the origin; ``moving`` has mass, place of
    the centre of mass and inertia about that of each moving mass.
    """
    bodies = [(m, np.asarray(s, dtype=float), np.asarray(own, dtype=float)) for m, s, own in moving]
    left = mass - sum(m for m, _, _ in bodies)
    place = -sum(m * s for m, s, _ in bodies) / left
    rest = np.array(inertia, dtype=float) - sum(own + steiner(m, s) for m, s, own in bodies)
    return left, place, rest - steiner(left, place)
