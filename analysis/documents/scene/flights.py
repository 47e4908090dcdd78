"""Several simulations of a system in one scene: their bodies at common times, failures marked.

Forces, lines and arrows of the declared scene are omitted, since campaigns seldom record their signals.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...runtime.flight.results import Flight
from ..common.colours import COLOURS
from ..figures.declared import Signal
from ..figures.scene.scene_elements import Attitude, Body, Position, SceneFigure, Site
from .notes import frame_note, size_note
from .poses import LocalFrame, attitudes, local_frame, positions, signals_of
from .quaternions import normalise
from .view import BodyView, FlightName, SceneView, SiteView, find_origin, ground_view


@dataclass(frozen=True)
class RecordedFlight:
    """A trial of a variant with its recorded signals, the variant's colour, and the trial's label in a view."""

    name: FlightName
    label: str
    colour: str
    flight: Flight


@dataclass(frozen=True)
class FlightsView:
    """A scene of several simulations, and the sentences below it."""

    scene: SceneView
    notes: list[str]


def flights_view(scene: SceneFigure, flights: Sequence[RecordedFlight]) -> FlightsView | None:
    """Return the scene of all simulations, or None if they recorded no position of a body.

    Positions are interpolated linearly at common times. After its end a simulation keeps its last position.
    """
    located = [body for body in scene.bodies if body.position is not None and _is_recorded(body.position, flights)]
    if not located or not flights:
        return None
    frame = local_frame(replace(scene, bodies=tuple(located)), flights[0].flight)
    time = np.unique(np.concatenate([each.flight.time for each in flights]))
    tracks = [[positions(body, each.flight, frame) for body in located] for each in flights]
    origin = find_origin(tracks[0][0])
    bodies = [
        _body_view(body, each, track - origin[:, None], time, frame, alone=len(located) == 1)
        for each, of_bodies in zip(flights, tracks, strict=True)
        for body, track in zip(located, of_bodies, strict=True)
    ]
    at_origin = [Site(body.name, (0.0, 0.0, 0.0)) for body in scene.bodies if body.position is None]
    sites = {site: _position_of(site, flights) for site in (*scene.sites, *at_origin)}
    view = SceneView(
        title=scene.title,
        axes=scene.axes,
        up=scene.up,
        origin=origin.tolist(),
        time=time,
        ground=ground_view(scene, tracks[0][0]),
        bodies=bodies,
        sites=[
            SiteView(site.name, COLOURS[-1], [np.full(time.size, each) for each in position - origin])
            for site, position in sites.items()
            if position is not None
        ],
    )
    without_position = [body.name for body in scene.bodies if body.position is not None and body not in located]
    notes = [
        frame_note(scene),
        *([size_note(oriented)] if (oriented := [body for body in located if _has_attitude(body, flights)]) else []),
        "After its end a flight stays where it was. Failures have dark paths and crosses.",
        *_unknown("attitude", [body.name for body in located if body not in oriented]),
        *_unknown("position", without_position),
        *(
            f"The position of {site.name} differs between trials or is not recorded."
            for site in sites
            if sites[site] is None
        ),
    ]
    return FlightsView(view, notes)


def _unknown(what: str, names: Iterable[str]) -> list[str]:
    return [f"The {what} of {name} is not recorded." for name in names]


def _is_recorded(part: Position | Attitude, flights: Sequence[RecordedFlight]) -> bool:
    names = signals_of(part)
    return all(names <= set(each.flight.signals) for each in flights)


def _has_attitude(body: Body, flights: Sequence[RecordedFlight]) -> bool:
    return body.attitude is None or _is_recorded(body.attitude, flights)


def _body_view(
    body: Body, recorded: RecordedFlight, track: np.ndarray, time: np.ndarray, frame: LocalFrame | None, *, alone: bool
) -> BodyView:
    flight = recorded.flight
    attitude = np.zeros((0, time.size))
    if _has_attitude(body, [recorded]):
        attitude = normalise(_resample(attitudes(body, flight, frame), flight.time, time))
    return BodyView(
        name=recorded.label if alone else f"{recorded.label}, {body.name}",
        colour=recorded.colour,
        shape=body.shape,
        size=body.size,
        at=body.at,
        position=list(_resample(track, flight.time, time)),
        attitude=list(attitude),
        panels=body.panels,
        flight=recorded.name,
    )


def _resample(values: np.ndarray, times: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Return values, [k, n], at other times; before the first and after the last sample they are constant."""
    return np.stack([np.interp(time, times, row) for row in values])


def _position_of(site: Site, flights: Sequence[RecordedFlight]) -> np.ndarray | None:
    """Return the position of a site, [3], or None unless it is constant in all simulations."""
    if not isinstance(site.position, Signal):
        return np.array(site.position)
    if not all(set(site.position.names) <= set(each.flight.signals) for each in flights):
        return None
    recorded = np.concatenate([site.position.values(each.flight) for each in flights], axis=1)
    return recorded[:, 0] if np.all(recorded == recorded[:, :1]) else None
