"""Hand-written scenes over hand-written runs: signals with known poses."""

from __future__ import annotations

from perilune.analysis.documents.figures.scene.scene_elements import Body, Cartesian, SceneFigure, Surface
from perilune.analysis.runtime.ssp.conversions import Unit
from tests.support.pages.own_samples import RADIAN, flown, scalar, vector

METRE = Unit("m", (0, 1, 0, 0, 0, 0, 0, 0))
SIZE = (2.0, 3.0, 4.0)


def body(name="ship", position=None, attitude=None, **more):
    declared = {"shape": "box", "size": SIZE, "at": (0.0, 0.0, 0.0), "thrusts": (), "jets": ()}
    return Body(name=name, position=position, attitude=attitude, **(declared | more))


def scene(*bodies, surface=None, **more):
    declared = {"title": "Scene", "notes": (), "frame": "inertial", "axes": ("x", "y", "z"), "up": "z"}
    return SceneFigure(**(declared | {"surface": surface, "bodies": bodies, "sites": (), "lines": ()} | more))


def cartesian():
    return Cartesian(vector("ship.position", 3, METRE))


def angle(name):
    return scalar(f"ship.{name}", RADIAN)


def sphere(radius):
    return Surface("Moon", radius, (0.0, 0.0, -radius))


__all__ = ["METRE", "SIZE", "angle", "body", "cartesian", "flown", "scalar", "scene", "sphere", "vector"]
