"""Elements of a three-dimensional scene: bodies with position and attitude, a ground, sites, jets, lines, arrows.

The frame of a scene is right-handed and that of the signals; its positions are in m. Where positions are longitude,
latitude and height it is east, north, up at the ground below the last sample. A sphere's centre is at
(0, 0, -radius) unless declared, a plane is z = 0. An attitude turns body axes to axes of the scene.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..declared import FigureDeclaration, Signal

Vector = tuple[float, float, float]
AxisNames = tuple[str, str, str]
AxisLetter = Literal["x", "y", "z"]
GROUND = "ground"
ARROW = 0.3  # length of an arrow over the view's height, unless declared
SHAPES = ("box", "capsule", "cylinder", "lander", "satellite")


@dataclass(frozen=True)
class Cartesian:
    """A position by its three coordinates (m)."""

    signal: Signal


@dataclass(frozen=True)
class Geographic:
    """A position by longitude and latitude (rad) and its height (m) over the sphere of the scene."""

    longitude: Signal
    latitude: Signal
    height: Signal


@dataclass(frozen=True)
class Quaternion:
    """An attitude by a quaternion from body to scene, scalar first, of any length."""

    signal: Signal


@dataclass(frozen=True)
class Angles:
    """An attitude by angles (rad): turns from the scene's axes, in this order, about the body's axes of ``sequence``.

    Each turn is about the axis as the turns before have left it.
    """

    signals: tuple[Signal, ...]
    sequence: str


@dataclass(frozen=True)
class ThrustAxis:
    """The direction of the body's z axis, of any length; the roll about it is unknown."""

    signal: Signal


@dataclass(frozen=True)
class WindAngles:
    """An attitude relative to the velocity over the ground, by angles (rad).

    Velocity axes: x along the velocity, y upwards in the vertical plane through it, z = x x y. From there bank about
    x, sideslip about y, angle of attack about z. The heading is from east, counter-clockwise from above.
    """

    bank: Signal
    sideslip_angle: Signal
    angle_of_attack: Signal
    flight_path_angle: Signal
    heading: Signal


Position = Cartesian | Geographic
Attitude = Quaternion | Angles | ThrustAxis | WindAngles


@dataclass(frozen=True)
class Thrust:
    """A force, ``signal``, ``along`` a unit vector of the body at the point ``at`` (m, body)."""

    signal: Signal
    at: Vector
    along: Vector


@dataclass(frozen=True)
class Jets:
    """Jets at points ``at`` (m, body) that push ``along`` unit vectors of the body, one for each element of ``signal``.

    The signal is a force, or a signed pulse length (s) where ``pulses`` is true: a sample's pulse starts at it, unless
    ``count`` is unchanged. Negative values push the other way. A ``couple`` is two jets, the second mirrored.
    """

    signal: Signal
    at: tuple[Vector, ...]
    along: tuple[Vector, ...]
    pulses: bool
    count: Signal | None
    couple: bool


@dataclass(frozen=True)
class Panel:
    """A plate of solar cells: its centre ``at`` and its ``size`` along the body's axes (m)."""

    at: Vector
    size: Vector


@dataclass(frozen=True)
class Body:
    """A body of a ``shape`` and its ``size`` along the body's axes (m), whose centre is ``at`` (m, body).

    Of a lander this is the centre of its base. Without a position it is at the origin, without an attitude its axes are
    those of the scene.
    """

    name: str
    shape: str
    size: Vector
    at: Vector
    position: Position | None
    attitude: Attitude | None
    thrusts: tuple[Thrust, ...]
    jets: tuple[Jets, ...]
    panels: tuple[Panel, ...] = ()


@dataclass(frozen=True)
class Surface:
    """The ground: a sphere of this ``radius`` around its ``centre`` (m), or the plane z = 0 where both are None."""

    name: str
    radius: float | None
    centre: Vector | None


@dataclass(frozen=True)
class Site:
    """A named point (m), which may move: a signal, or constants."""

    name: str
    position: Signal | Vector


@dataclass(frozen=True)
class Line:
    """A line between two bodies or sites, or to the `GROUND` below; shown while ``condition`` is not 0."""

    name: str
    start: str
    end: str
    condition: Signal | None


@dataclass(frozen=True)
class Arrow:
    """The direction of a ``signal`` of three elements, of any unit and length, from the body or site ``start``.

    Its components are along the axes of the body ``frame``, or those of the scene where that is None. The arrow's
    ``length`` is in m; where that is None it is `ARROW` of the view's height at any distance. ``colour`` is a name of
    `HUES`, or None for the next one.
    """

    name: str
    start: str
    signal: Signal
    frame: str | None
    length: float | None
    colour: str | None


@dataclass(frozen=True)
class SceneFigure(FigureDeclaration):
    """Bodies in a ``frame``, whose ``axes`` have names; ``up`` is one of them."""

    frame: str
    axes: AxisNames
    up: AxisLetter
    surface: Surface | None
    bodies: tuple[Body, ...]
    sites: tuple[Site, ...]
    lines: tuple[Line, ...]
    arrows: tuple[Arrow, ...] = ()
