"""Bodies as a few plane facets, for pictures without scripts; web/scene/objects/shapes.ts draws them in detail.

Each solid is a box, or a frustum about z, in fractions of the body's extents.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..common.colours import SHIP
from .view import BodyView

FOIL, METAL, DARK, SHIELD, PANEL, MARK = SHIP.values()
SIDES = 24  # sides of round solids
X_FORWARD = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])  # rotates z to x
LEG = 0.02  # width of a leg


class Facet(NamedTuple):
    """A plane convex facet with a ``colour``: its corners (m, body axes), [n, 3], and its outward unit normal, [3]."""

    colour: str
    corners: np.ndarray
    normal: np.ndarray


def facets_of(body: BodyView) -> list[Facet]:
    """Return the facets of a body and its panels."""
    size, at = np.array(body.size), np.array(body.at)
    facets = [_facet(colour, corners * size + at, middle * size + at) for colour, corners, middle in _unit(body)]
    for panel in body.panels:
        facets += [_facet(PANEL, corners, np.array(panel.at)) for corners in _box(panel.at, panel.size)]
    return facets


def _facet(colour: str, corners: np.ndarray, middle: np.ndarray) -> Facet:
    """Return a facet of a convex solid around ``middle``."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    normal = normal / np.linalg.norm(normal)
    return Facet(colour, corners, normal if normal @ (corners.mean(axis=0) - middle) > 0.0 else -normal)


Solid = tuple[str, list[np.ndarray]]


def _unit(body: BodyView) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Yield, for each facet of a shape of extents 1, its colour, its corners, and the centre of its solid."""
    solids = {"box": _plain, "cylinder": _cylinder, "capsule": _capsule, "lander": _lander}
    for colour, facets in _satellite(body.size) if body.shape == "satellite" else solids[body.shape]():
        middle = np.concatenate(facets).mean(axis=0)
        yield from ((colour, corners, middle) for corners in facets)


def _plain() -> list[Solid]:
    return [
        (METAL, _box((-0.03, 0.0, -0.02), (0.94, 1.0, 0.96))),
        (MARK, _box((0.47, 0.0, 0.0), (0.06, 0.5, 0.5))),
        (DARK, _box((-0.05, 0.0, 0.48), (0.6, 0.6, 0.04))),
    ]


def _cylinder() -> list[Solid]:
    return [(METAL, _frustum(0.5, 0.5, -0.5, 0.42)), (DARK, _frustum(0.5, 0.3, 0.42, 0.5))]


def _capsule() -> list[Solid]:
    solids = [(METAL, _frustum(0.2, 0.5, -0.5, 0.22)), (SHIELD, _frustum(0.5, 0.2, 0.22, 0.5))]
    return [(colour, [corners @ X_FORWARD.T for corners in facets]) for colour, facets in solids]


def _lander() -> list[Solid]:
    solids = [
        (FOIL, _frustum(0.3, 0.3, 0.3, 0.68, 8)),
        (METAL, _frustum(0.3, 0.2, 0.68, 0.8, 8)),
        (METAL, _frustum(0.1, 0.1, 0.8, 0.92)),
        (DARK, _frustum(0.05, 0.12, 0.14, 0.3)),
        (MARK, _box((0.285, 0.0, 0.49), (0.02, 0.2, 0.2))),
    ]
    for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        hip, foot = np.array([0.2 * x, 0.2 * y, 0.6]), np.array([0.42 * x, 0.42 * y, 0.0])
        square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * LEG / 2.0
        solids.append((METAL, _between(square + foot, square + hip)))
    return solids


def _satellite(size: Sequence[float]) -> list[Solid]:
    """Return a bus with a panel at either side, along the longer of y and z."""
    along = 2 if size[2] > size[1] else 1
    bus = min(size[3 - along] / size[along], 0.36)
    extents = np.array([1.0, 1.0, 1.0])
    extents[along] = bus
    solids = [(METAL, _box((-0.02, 0.0, 0.0), extents * [0.96, 1.0, 1.0]))]
    solids.append((MARK, _box((0.48, 0.0, 0.0), extents * [0.04, 0.5, 0.5])))
    length = (1.0 - bus) / 2.0
    for side in (1.0, -1.0):
        middle, panel = np.zeros(3), np.array([0.5, 0.03, 0.03])
        middle[along], panel[along] = side * (bus + length) / 2.0, 0.96 * length
        solids.append((PANEL, _box(middle, panel)))
    return solids


def _box(middle: Sequence[float] | np.ndarray, extents: Sequence[float] | np.ndarray) -> list[np.ndarray]:
    square = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    bottom, top = (np.column_stack([square, np.full(4, end)]) * extents + middle for end in (-0.5, 0.5))
    return _between(bottom, top)


def _frustum(bottom: float, top: float, low: float, high: float, sides: int = SIDES) -> list[np.ndarray]:
    """Return the faces of a frustum between regular polygons with these radii at z = ``low`` and z = ``high``."""
    angle = (np.arange(sides) + 0.5) * 2.0 * np.pi / sides
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros(sides)], axis=1)
    return _between(bottom * circle + [0.0, 0.0, low], top * circle + [0.0, 0.0, high])


def _between(bottom: np.ndarray, top: np.ndarray) -> list[np.ndarray]:
    """Return the two end polygons, [n, 3], and the faces between them."""
    after = np.roll(np.arange(len(bottom)), -1)
    sides = [np.stack([bottom[k], bottom[n], top[n], top[k]]) for k, n in enumerate(after)]
    return [bottom, top, *sides]
