"""Data of a scene for a page's script: poses of its bodies, and everything drawn with them.

Positions are relative to `SceneView.origin`, so the resolution of float32 at the end of a flight is better than a
millimetre. Arrays are columns of the page, [samples].
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...runtime.flight.results import FlightResult
from ..common.colours import COLOURS, HUES
from ..common.quantities import display_unit
from ..common.round_body import track_normal
from ..figures.declared import Signal
from ..figures.scene.scene_elements import (
    ARROW,
    GROUND,
    Arrow,
    AxisLetter,
    AxisNames,
    Body,
    Jets,
    Line,
    Panel,
    SceneFigure,
    Site,
    Vector,
)
from .notes import largest_magnitude, plume_length
from .poses import Pose, compute_poses
from .quaternions import normalise, rotate


@dataclass(frozen=True, kw_only=True)
class ThrustView:
    """A force: values in ``unit``, point and direction of action (body axes), and the plume's ``length`` (m).

    The plume has this length at the ``largest`` magnitude.
    """

    values: np.ndarray
    largest: float
    length: float
    unit: str = ""
    label: str
    at: Vector
    along: Vector


@dataclass(frozen=True, kw_only=True)
class JetView:
    """A jet: its force relative to the ``largest`` of its group, or the signed remaining time (s) of its pulse."""

    values: np.ndarray
    largest: float
    pulse: bool = False
    couple: bool = False
    at: Vector
    along: Vector


@dataclass(frozen=True)
class FlightName:
    """Trial and variant of a body, and whether the trial failed."""

    variant: str
    trial: int
    failed: bool = False


@dataclass(frozen=True)
class BodyView:
    """A body: three columns of position (m), and four of its attitude quaternion from body to scene, scalar first.

    ``attitude`` is empty if unknown; ``flight`` is stated in a scene of several simulations.
    """

    name: str
    colour: str
    shape: str
    size: Vector
    at: Vector
    position: Sequence[np.ndarray]
    attitude: Sequence[np.ndarray]
    thrusts: Sequence[ThrustView] = ()
    jets: Sequence[JetView] = ()
    panels: Sequence[Panel] = ()
    flight: FlightName | None = None


@dataclass(frozen=True)
class SiteView:
    """A named point: three columns of position (m)."""

    name: str
    colour: str
    position: Sequence[np.ndarray]


@dataclass(frozen=True)
class LineView:
    """A line from a named point to another, or without ``end`` to the ground below."""

    start: str
    end: str | None = None
    condition: np.ndarray | None = None


@dataclass(frozen=True)
class ArrowView:
    """An arrow from a named point: three columns of a unit vector in the scene's frame, NaN where unknown.

    ``length`` is in m, or if ``on_screen`` a fraction of the view's height.
    """

    name: str
    colour: str
    start: str
    direction: Sequence[np.ndarray]
    length: float
    on_screen: bool = False


@dataclass(frozen=True)
class GroundView:
    """The ground: the plane z = 0, or a sphere by ``radius`` and ``centre`` (m, in the scene's frame).

    The grid of a sphere is aligned with the great circle of this ``normal``.
    """

    name: str
    radius: float | None = None
    centre: Vector | None = None
    normal: Vector | None = None


@dataclass(frozen=True)
class CameraStart:
    """The initial camera: its vertical ``field``, its direction from a body (rad), its distance.

    The azimuth is an angle about the up axis from the forward direction. The distance is ``diagonals`` diagonals of the
    body, or more if needed to have all bodies in view, with ``room`` as a factor on their extent.
    """

    field: float
    azimuth: float
    elevation: float
    diagonals: float
    room: float


START = CameraStart(field=math.radians(40.0), azimuth=2.5, elevation=0.25, diagonals=3.6, room=1.15)


@dataclass(frozen=True, kw_only=True)
class SceneView:
    """A scene of a simulation with samples at ``time`` (s)."""

    title: str
    axes: AxisNames
    up: AxisLetter
    origin: Vector
    time: np.ndarray
    ground: GroundView | None = None
    bodies: Sequence[BodyView]
    sites: Sequence[SiteView] = ()
    lines: Sequence[LineView] = ()
    arrows: Sequence[ArrowView] = ()
    camera: CameraStart = START


def scene_view(scene: SceneFigure, result: FlightResult) -> SceneView | None:
    """Return the scene of a simulation, or None if there are no samples."""
    if not result.time.size:
        return None
    poses = compute_poses(scene, result)
    origin = find_origin(poses[0].position)
    names = [*(body.name for body in scene.bodies), *(site.name for site in scene.sites)]
    colours = {name: COLOURS[index % len(COLOURS)] for index, name in enumerate(names)}
    frames: dict[str | None, np.ndarray] = {
        body.name: pose.attitude for body, pose in zip(scene.bodies, poses, strict=True)
    }
    return SceneView(
        title=scene.title,
        axes=scene.axes,
        up=scene.up,
        origin=origin.tolist(),
        time=result.time,
        ground=ground_view(scene, poses[0].position),
        bodies=[
            _body(body, pose, origin, colours[body.name], result)
            for body, pose in zip(scene.bodies, poses, strict=True)
        ],
        sites=[_site(site, origin, colours[site.name], result) for site in scene.sites],
        lines=[_line(line, result) for line in scene.lines],
        arrows=[
            _arrow(arrow, frames.get(arrow.frame), COLOURS[index % len(COLOURS)], result)
            for index, arrow in enumerate(scene.arrows, len(names))
        ],
    )


def position_at(point: BodyView | SiteView, row: int) -> np.ndarray:
    """Return the position (m), [3], of a body or a site at a sample, relative to the view's origin."""
    return np.array([column[row] for column in point.position])


def find_origin(position: np.ndarray) -> np.ndarray:
    """Return the origin of a view's positions: the last finite position, [3]."""
    finite = position[:, np.all(np.isfinite(position), axis=0)]
    return finite[:, -1] if finite.size else np.zeros(3)


def ground_view(scene: SceneFigure, position: np.ndarray) -> GroundView | None:
    """Return the ground of a scene below a path with these positions (m), [3, n], or None if there is none."""
    surface = scene.surface
    if surface is None:
        return None
    normal = None if surface.centre is None else track_normal(position, surface.centre).tolist()
    return GroundView(surface.name, surface.radius, surface.centre, normal)


def _body(body: Body, pose: Pose, origin: np.ndarray, colour: str, result: FlightResult) -> BodyView:
    return BodyView(
        name=body.name,
        colour=colour,
        shape=body.shape,
        size=body.size,
        at=body.at,
        position=list(pose.position - origin[:, None]),
        attitude=list(pose.attitude),
        thrusts=[
            ThrustView(
                values=(values := thrust.signal.values(result)[0]),
                largest=largest_magnitude(values),
                length=plume_length(body),
                unit=display_unit(thrust.signal.unit_name),
                label=thrust.signal.label,
                at=thrust.at,
                along=thrust.along,
            )
            for thrust in body.thrusts
        ],
        jets=[view for jets in body.jets for view in _jets(jets, result)],
        panels=body.panels,
    )


def _jets(jets: Jets, result: FlightResult) -> list[JetView]:
    values = jets.signal.values(result)
    if jets.pulses:
        values = remaining_pulses(result.time, values, None if jets.count is None else jets.count.values(result)[0])
    largest = largest_magnitude(values)
    return [
        JetView(values=row, largest=largest, pulse=jets.pulses, couple=jets.couple, at=at, along=along)
        for row, at, along in zip(values, jets.at, jets.along, strict=True)
    ]


def remaining_pulses(time: np.ndarray, lengths: np.ndarray, count: np.ndarray | None) -> np.ndarray:
    """Return the signed remaining time (s) of pulses at each sample, [jets, n]; 0 without a pulse.

    A pulse of ``lengths``, [jets, n], starts at its sample; with ``count``, [n], only if that differs from the previous
    sample.
    """
    if count is None:
        return np.where(np.isfinite(lengths), lengths, 0.0)
    starts = np.concatenate([[True], count[1:] != count[:-1]])
    start = np.maximum.accumulate(np.where(starts, np.arange(time.size), 0))
    fired = np.where(np.isfinite(lengths[:, start]), lengths[:, start], 0.0)
    return np.sign(fired) * np.maximum(np.abs(fired) - (time - time[start]), 0.0)


def _site(site: Site, origin: np.ndarray, colour: str, result: FlightResult) -> SiteView:
    if isinstance(site.position, Signal):
        position = site.position.values(result)
    else:
        position = np.tile(np.array(site.position)[:, None], result.time.size)
    return SiteView(site.name, colour, list(position - origin[:, None]))


def _line(line: Line, result: FlightResult) -> LineView:
    condition = None if line.condition is None else line.condition.values(result)[0]
    return LineView(line.start, None if line.end == GROUND else line.end, condition)


def _arrow(arrow: Arrow, frame: np.ndarray | None, colour: str, flight: FlightResult) -> ArrowView:
    """Return an arrow with components along the axes of this attitude, [4, n], or along the scene's axes."""
    direction = normalise(arrow.signal.values(flight))
    return ArrowView(
        name=arrow.name,
        colour=colour if arrow.colour is None else HUES[arrow.colour],
        start=arrow.start,
        direction=list(direction if frame is None else rotate(frame, direction)),
        length=ARROW if arrow.length is None else arrow.length,
        on_screen=arrow.length is None,
    )
