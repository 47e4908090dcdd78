"""Elements of a three-dimensional scene: bodies with position and attitude, a ground, sites, jets, lines, arrows.

The frame of a scene is the right-handed frame of its signals; positions are in m. If positions are longitude, latitude
and height, the frame is east, north, up at the ground below the last sample. A sphere's centre is by default at (0, 0,
-radius); a plane is z = 0. An attitude rotates body axes to axes of the scene.
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
    """A position by three coordinates (m)."""

    signal: Signal


@dataclass(frozen=True)
class Geographic:
    """A position by longitude and latitude (rad) and height (m) above the sphere of the scene."""

    longitude: Signal
    latitude: Signal
    height: Signal


@dataclass(frozen=True)
class Quaternion:
    """An attitude by a quaternion from body to scene, scalar first, of any norm."""

    signal: Signal


@dataclass(frozen=True)
class Angles:
    """An attitude by angles (rad): successive rotations from the scene's axes about the body axes of ``sequence``.

    Each rotation is about the axis as rotated by the previous ones.
    """

    signals: tuple[Signal, ...]
    sequence: str


@dataclass(frozen=True)
class ThrustAxis:
    """The direction of the body's z axis, a vector of any length; the roll about it is unknown."""

    signal: Signal


@dataclass(frozen=True)
class WindAngles:
    """An attitude relative to the velocity over the ground, by angles (rad).

    Velocity axes: x along the velocity, y upwards in the vertical plane through it, z completes the right-handed frame.
    The velocity axes are rotated by bank about x, sideslip about y, angle of attack about z. The heading is from east,
    counter-clockwise as viewed from above.
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
    """A force of magnitude ``signal`` along the body's unit vector ``along`` at the point ``at`` (m, body axes)."""

    signal: Signal
    at: Vector
    along: Vector


@dataclass(frozen=True)
class Jets:
    """Jets at points ``at`` (m, body axes) with forces ``along`` unit vectors, one per element of ``signal``.

    The signal is a force, or with ``pulses`` a signed pulse length (s): a pulse starts at its sample, unless ``count``
    is unchanged. Negative values reverse the force. A ``couple`` is two jets, the second one mirrored.
    """

    signal: Signal
    at: tuple[Vector, ...]
    along: tuple[Vector, ...]
    pulses: bool
    count: Signal | None
    couple: bool


@dataclass(frozen=True)
class Panel:
    """A solar panel: its centre ``at`` and its ``size`` along the body's axes (m)."""

    at: Vector
    size: Vector


@dataclass(frozen=True)
class Body:
    """A body of a ``shape`` and ``size`` along its axes (m); its centre is ``at`` (m, body axes).

    For a lander this is the centre of its base. A body without position is at the origin, and the axes of a body
    without attitude are those of the scene.
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
    """The ground: a sphere of ``radius`` around ``centre`` (m), or the plane z = 0 if both are None."""

    name: str
    radius: float | None
    centre: Vector | None


@dataclass(frozen=True)
class Site:
    """A named point (m): a signal if it moves, or constants."""

    name: str
    position: Signal | Vector


@dataclass(frozen=True)
class Line:
    """A line between two bodies or sites, or to the `GROUND` below; visible while ``condition`` is not 0."""

    name: str
    start: str
    end: str
    condition: Signal | None


@dataclass(frozen=True)
class Arrow:
    """The direction of a three-element ``signal``, of any unit and length, from the body or site ``start``.

    Its components are along the axes of the body ``frame``, or of the scene (None). ``length`` is in m; an arrow
    without length takes the fraction `ARROW` of the view's height at any distance. ``colour`` is a name of `HUES`; None
    selects the next colour.
    """

    name: str
    start: str
    signal: Signal
    frame: str | None
    length: float | None
    colour: str | None


@dataclass(frozen=True)
class SceneFigure(FigureDeclaration):
    """Bodies in a ``frame`` with named ``axes``; ``up`` is one of them."""

    frame: str
    axes: AxisNames
    up: AxisLetter
    surface: Surface | None
    bodies: tuple[Body, ...]
    sites: tuple[Site, ...]
    lines: tuple[Line, ...]
    arrows: tuple[Arrow, ...] = ()
