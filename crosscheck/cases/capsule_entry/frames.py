"""From angles over the rotating Earth and to the velocity, to inertial axes: those of the Earth at the start."""

import numpy as np

from crosscheck.cases.capsule_entry.case import EARTH_RATE

X, Y, Z = np.eye(3)


def to_inertial(
    time: np.ndarray, geocentric: np.ndarray, motion: np.ndarray, attitude: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return position (m), velocity (m/s), quaternion from body to inertial, each with a column per time (s).

    Rows: radius, longitude, latitude; speed, flight-path angle, heading over the Earth; bank, sideslip, angle of
    attack.
    """
    radius, longitude, latitude = geocentric
    speed, flight_path_angle, heading = motion
    bank, sideslip_angle, angle_of_attack = attitude
    identity = np.eye(4)[:, :1] * np.ones(time.size)
    local = _then(_then(identity, longitude + EARTH_RATE * time, Z), -latitude, Y)  # up, east, north
    position = radius * _rotate(local, X)
    level = _then(_then(local, heading, X), np.full(time.size, np.pi), (X + Y) / np.sqrt(2.0))  # ahead, up, right
    along = _then(level, flight_path_angle, Z)
    velocity = speed * _rotate(along, X) + EARTH_RATE * np.cross(Z[:, None], position, axis=0)
    return position, velocity, _then(_then(_then(along, bank, X), sideslip_angle, Y), angle_of_attack, Z)


def _then(first: np.ndarray, angle: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Return quaternions [4, n], scalar first, followed by rotations by angles (rad) about an axis of their frame."""
    a, u = first[0], first[1:]
    b, v = np.cos(0.5 * angle), axis[:, None] * np.sin(0.5 * angle)
    return np.vstack([a * b - np.sum(u * v, axis=0), a * v + b * u + np.cross(u, v, axis=0)])


def _rotate(q: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Return a vector of the rotated frame in the frame that it is rotated from, [3, n]."""
    across = np.cross(q[1:], vector[:, None], axis=0)
    return vector[:, None] + 2.0 * (q[0] * across + np.cross(q[1:], across, axis=0))
