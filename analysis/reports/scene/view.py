"""What a page's script gets of a scene: the poses of its bodies and all that is drawn with them.

Positions are relative to `SceneView.origin`, so that float32 is exact to less than a millimetre where a flight ends.
Arrays are columns of the page, [samples].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...runtime.flight.results import Result
from ..common.quantities import display_unit
from ..common.round_body import track_normal
from ..common.style import COLOURS
from ..figures.declared import Signal
from ..figures.scene.declared import GROUND, Body, Jets, Line, Scene, Site
from .notes import largest_magnitude, plume_length
from .poses import Pose, compute_poses

Numbers = Sequence[float]


@dataclass(frozen=True)
class ThrustView:
    """A force: its values in ``unit``, where it acts and along which direction (body), and its plume's ``length`` (m).

    The plume has this length at the ``largest`` magnitude.
    """

    values: np.ndarray
    largest: float
    length: float
    unit: str
    label: str
    at: Numbers
    along: Numbers


@dataclass(frozen=True)
class JetView:
    """A jet: its force over the ``largest`` of its group, or the time (s) that its pulse still lasts, with its sign."""

    values: np.ndarray
    largest: float
    pulse: bool
    couple: bool
    at: Numbers
    along: Numbers


@dataclass(frozen=True)
class FlightName:
    """Which trial of which variant a body is of, and whether that failed."""

    variant: str
    trial: int
    failed: bool


@dataclass(frozen=True)
class BodyView:
    """A body: three columns of position (m) and four of its attitude, a quaternion from body to scene, scalar first.

    ``attitude`` is empty where it is unknown, ``flight`` is given in a scene of several flights.
    """

    name: str
    colour: str
    shape: str
    size: Numbers
    at: Numbers
    position: Sequence[np.ndarray]
    attitude: Sequence[np.ndarray]
    thrusts: Sequence[ThrustView]
    jets: Sequence[JetView]
    flight: FlightName | None = None


@dataclass(frozen=True)
class SiteView:
    """A named point: three columns (m)."""

    name: str
    colour: str
    position: Sequence[np.ndarray]


@dataclass(frozen=True)
class LineView:
    """A line from a point to another, named; to the ground below where ``end`` is missing."""

    name: str
    start: str
    end: str | None
    condition: np.ndarray | None


@dataclass(frozen=True)
class GroundView:
    """The ground; of a sphere its ``radius`` (m) and the ``normal`` of the great circle on which its grid is laid."""

    name: str
    radius: float | None
    normal: Numbers | None


@dataclass(frozen=True)
class SceneView:
    """A scene of a flight with samples at ``time`` (s)."""

    title: str
    axes: Sequence[str]
    up: str
    origin: Numbers
    time: np.ndarray
    ground: GroundView | None
    bodies: Sequence[BodyView]
    sites: Sequence[SiteView]
    lines: Sequence[LineView]


def scene_view(scene: Scene, result: Result) -> SceneView | None:
    """The scene of a flight; None for one without samples."""
    if not result.time.size:
        return None
    poses = compute_poses(scene, result)
    origin = find_origin(poses[0].position)
    names = [*(body.name for body in scene.bodies), *(site.name for site in scene.sites)]
    colours = {name: COLOURS[index % len(COLOURS)] for index, name in enumerate(names)}
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
    )


def find_origin(position: np.ndarray) -> np.ndarray:
    """What a view's positions are relative to: the last finite position, [3]."""
    finite = position[:, np.all(np.isfinite(position), axis=0)]
    return finite[:, -1] if finite.size else np.zeros(3)


def ground_view(scene: Scene, position: np.ndarray) -> GroundView | None:
    """The ground of a scene below a flight with these positions (m), [3, n]; None where it has none."""
    surface = scene.surface
    if surface is None:
        return None
    if surface.radius is None:
        return GroundView(surface.name, None, None)
    return GroundView(surface.name, surface.radius, track_normal(position, surface.radius).tolist())


def _body(body: Body, pose: Pose, origin: np.ndarray, colour: str, result: Result) -> BodyView:
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
    )


def _jets(jets: Jets, result: Result) -> list[JetView]:
    values = jets.signal.values(result)
    if jets.pulses:
        values = remaining_pulses(result.time, values, None if jets.count is None else jets.count.values(result)[0])
    largest = largest_magnitude(values)
    return [
        JetView(row, largest, jets.pulses, jets.couple, at, along)
        for row, at, along in zip(values, jets.at, jets.along, strict=True)
    ]


def remaining_pulses(time: np.ndarray, lengths: np.ndarray, count: np.ndarray | None) -> np.ndarray:
    """What is left (s) of signed pulses at each sample, [jets, n]; 0 where none is fired.

    A pulse of ``lengths``, [jets, n], starts at its sample; with ``count``, [n], only where that differs from the
    sample before.
    """
    if count is None:
        return np.where(np.isfinite(lengths), lengths, 0.0)
    starts = np.concatenate([[True], count[1:] != count[:-1]])
    start = np.maximum.accumulate(np.where(starts, np.arange(time.size), 0))
    fired = np.where(np.isfinite(lengths[:, start]), lengths[:, start], 0.0)
    return np.sign(fired) * np.maximum(np.abs(fired) - (time - time[start]), 0.0)


def _site(site: Site, origin: np.ndarray, colour: str, result: Result) -> SiteView:
    if isinstance(site.position, Signal):
        position = site.position.values(result)
    else:
        position = np.tile(np.array(site.position)[:, None], result.time.size)
    return SiteView(site.name, colour, list(position - origin[:, None]))


def _line(line: Line, result: Result) -> LineView:
    condition = None if line.condition is None else line.condition.values(result)[0]
    return LineView(line.name, line.start, None if line.end == GROUND else line.end, condition)
