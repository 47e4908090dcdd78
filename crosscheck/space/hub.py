"""The hub that is left of a whole without the masses that move in it. Needs numpy alone."""

from collections.abc import Iterable

import numpy as np


def steiner(mass: float, position: np.ndarray) -> np.ndarray:
    """Return the inertia (kg m2) of a point mass (kg) at a position (m) about the origin."""
    return mass * (position @ position * np.eye(3) - np.outer(position, position))


def hub_of(
    mass: float, inertia: object, masses: Iterable[tuple[float, np.ndarray, np.ndarray]]
) -> tuple[float, np.ndarray, np.ndarray]:
    """Return mass (kg), centre of mass (m) and inertia about it (kg m2) of the hub.

    ``mass`` and ``inertia`` are those of the whole, whose centre of mass is the origin; ``masses`` has mass, centre of
    mass and inertia about that of each one that moves.
    """
    bodies = [(m, np.asarray(s, dtype=float), np.asarray(i, dtype=float)) for m, s, i in masses]
    hub_mass = mass - sum(m for m, _, _ in bodies)
    centre = -sum(m * s for m, s, _ in bodies) / hub_mass
    about_origin = np.array(inertia, dtype=float) - sum(i + steiner(m, s) for m, s, i in bodies)
    return hub_mass, centre, about_origin - steiner(hub_mass, centre)
