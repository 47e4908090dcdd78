"""Position and attitude of a scene's body at every sample of a simulation."""

from __future__ import annotations

from dataclasses import fields
from typing import NamedTuple

import numpy as np

from ...runtime.flight.results import Flight
from ..figures.declared import Signal
from ..figures.scene.scene_elements import (
    Angles,
    Attitude,
    Body,
    Cartesian,
    Geographic,
    Position,
    Quaternion,
    SceneFigure,
    Site,
    ThrustAxis,
    WindAngles,
)
from .quaternions import compose_rotations, make_continuous, multiply, normalise, transport_axis


class Pose(NamedTuple):
    """Positions (m), [3, n], and unit quaternions from body to scene, scalar first, [4, n]; NaN where unknown."""

    position: np.ndarray
    attitude: np.ndarray


class LocalFrame(NamedTuple):
    """East, north, up at a ground point: its longitude and latitude (rad), and the sphere's radius (m)."""

    longitude: float
    latitude: float
    radius: float


def compute_poses(scene: SceneFigure, flight: Flight) -> list[Pose]:
    """Return the pose of each body at each sample in the scene's frame."""
    frame = local_frame(scene, flight)
    return [Pose(positions(body, flight, frame), attitudes(body, flight, frame)) for body in scene.bodies]


def local_frame(scene: SceneFigure, flight: Flight) -> LocalFrame | None:
    """Return the frame at the ground below the first body's last finite sample, or None for Cartesian positions."""
    position = scene.bodies[0].position
    if not isinstance(position, Geographic) or scene.surface is None or scene.surface.radius is None:
        return None
    angles = np.concatenate([position.longitude.values(flight), position.latitude.values(flight)])
    finite = angles[:, np.all(np.isfinite(angles), axis=0)]
    longitude, latitude = finite[:, -1] if finite.size else (0.0, 0.0)
    return LocalFrame(float(longitude), float(latitude), scene.surface.radius)


def positions(body: Body, flight: Flight, frame: LocalFrame | None) -> np.ndarray:
    """Return positions (m) of a body at each sample, [3, n]; NaN where unknown."""
    position: Position | None = body.position
    if isinstance(position, Cartesian):
        values = position.signal.values(flight)
        return np.where(np.all(np.isfinite(values), axis=0), values, np.nan)
    if isinstance(position, Geographic) and frame is not None:
        longitude, latitude = position.longitude.values(flight)[0], position.latitude.values(flight)[0]
        return to_local(longitude, latitude, position.height.values(flight)[0], frame)
    return np.zeros((3, flight.time.size))


def to_local(longitude: np.ndarray, latitude: np.ndarray, height: np.ndarray, frame: LocalFrame) -> np.ndarray:
    """Return positions (m), [3, n], in a local frame from longitude, latitude (rad) and height (m).

    With d the difference in longitude, half angles maintain precision near the ground point: up = h - 2 (R + h)
    (sin^2((lat - lat0)/2) + cos lat cos lat0 sin^2(d/2)).
    """
    sine, cosine = np.sin(frame.latitude), np.cos(frame.latitude)
    difference = longitude - frame.longitude
    haversine = np.sin(0.5 * (latitude - frame.latitude)) ** 2
    haversine = haversine + np.cos(latitude) * cosine * np.sin(0.5 * difference) ** 2
    east = np.cos(latitude) * np.sin(difference)
    north = np.sin(latitude - frame.latitude) + 2.0 * np.cos(latitude) * sine * np.sin(0.5 * difference) ** 2
    distance = frame.radius + height
    return np.stack([distance * east, distance * north, height - 2.0 * distance * haversine])


def attitudes(body: Body, flight: Flight, frame: LocalFrame | None) -> np.ndarray:
    """Return unit quaternions from body to scene at each sample, scalar first, [4, n]; NaN where unknown."""
    return make_continuous(_attitudes(body, flight, frame))


def signals_of(part: Position | Attitude | Site | None) -> set[str]:
    """Return the recorded signals from which a position, an attitude or a site is computed."""
    stated = () if part is None else (getattr(part, each.name) for each in fields(part))
    signals = (signal for each in stated for signal in (each if isinstance(each, tuple) else (each,)))
    return {name for signal in signals if isinstance(signal, Signal) for name in signal.names}


def _attitudes(body: Body, flight: Flight, frame: LocalFrame | None) -> np.ndarray:
    attitude: Attitude | None = body.attitude
    match attitude:
        case Quaternion():
            return normalise(attitude.signal.values(flight))
        case Angles():
            angles = np.concatenate([signal.values(flight) for signal in attitude.signals])
            return compose_rotations(zip(attitude.sequence, angles, strict=True), flight.time.size)
        case ThrustAxis():
            return transport_axis(attitude.signal.values(flight))
        case WindAngles() if isinstance(body.position, Geographic) and frame is not None:
            return _wind_attitudes(attitude, body.position, flight, frame)
    return compose_rotations([], flight.time.size)


def _wind_attitudes(attitude: WindAngles, position: Geographic, flight: Flight, frame: LocalFrame) -> np.ndarray:
    """Return quaternions from body axes, via velocity axes and the local horizon, to the frame of the scene."""
    longitude, latitude = position.longitude.values(flight)[0], position.latitude.values(flight)[0]
    bank, sideslip_angle, angle_of_attack, flight_path_angle, heading = (
        signal.values(flight)[0]
        for signal in (
            attitude.bank,
            attitude.sideslip_angle,
            attitude.angle_of_attack,
            attitude.flight_path_angle,
            attitude.heading,
        )
    )
    size = flight.time.size
    quarter = np.full(size, 0.5 * np.pi)
    to_fixed = compose_rotations([("z", longitude + quarter), ("x", quarter - latitude)], size)
    to_scene = compose_rotations([("x", frame.latitude - quarter), ("z", -frame.longitude - quarter)], size)
    to_horizon = compose_rotations([("z", heading), ("y", -flight_path_angle), ("x", quarter)], size)
    to_velocity = compose_rotations([("x", bank), ("y", sideslip_angle), ("z", angle_of_attack)], size)
    return multiply(multiply(to_scene, to_fixed), multiply(to_horizon, to_velocity))
