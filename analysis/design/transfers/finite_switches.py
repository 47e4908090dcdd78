"""Best profile with a finite number of switches of angular acceleration: equation (3) as in the paper.

The angular acceleration is at its negative and then at its positive limit, pitch follows the tangent law (2) from t3 to
t4, and the angular acceleration is again at its negative and then at its positive limit; thrust is full in two burns.
The constants c1 to c4 of the law are equivalent to three: pitch is direction + atan((t - nearest)/scale), the direction
from a fixed point to a point that moves along a straight line. Source: Huang 2017, equation (3) and the programme of
pitch that follows it, before its simplification.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..trajectories.vehicle import Vehicle
from .nonlinear import minimise
from .programme import Programme

FAR, FAST, TURNING = 100.0, 5.0, 0.05  # m, m/s and rad/s of equal weight, as 1 rad
SCALE = 1e3  # scale of the propellant fraction
SHORTEST = 1e-3  # s, least duration of a burn
LONGEST = 8.0  # s, longest interval of the quadrature
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
NODES, WEIGHTS = (NODES + 1.0) / 2.0, WEIGHTS / 2.0  # over [0, 1]
HALF = math.pi / 2.0


@dataclass(frozen=True)
class FiniteProfile:
    """Profile: switching ``times`` t2, t3, t4, t5, t7 (s); ``tangent``: direction (rad), nearest and scale (s).

    ``burns`` contains begin and duration of the first burn and duration of the last (s); ``propellant_fraction`` is the
    total.
    """

    times: tuple[float, ...]
    tangent: tuple[float, ...]
    burns: tuple[float, ...]
    propellant_fraction: float

    @property
    def duration(self) -> float:
        """Duration, s."""
        return self.times[-1]

    @property
    def full_thrust(self) -> list[tuple[float, float]]:
        """Begin and end (s) of both burns."""
        begin, first, last = self.burns
        burns = [(begin, begin + first), (self.duration - last, self.duration)]
        return [burn for burn in burns if burn[1] - burn[0] > SHORTEST]


def find_finite_switches(near: Programme) -> FiniteProfile | None:
    """Return the profile of least propellant near a simplified programme with two burns, None if there is none."""
    vehicle, transfer, shape = near.vehicle, near.transfer, near.shape()
    if not (shape.d > 0.0 and shape.t4 > shape.t3):
        return None
    swing = vehicle.angular_acceleration
    direction = HALF + swing * (shape.d**2 / 2.0 - shape.t1**2 + shape.d * (shape.t4 - shape.t3) / 2.0)
    guess = [
        shape.t2, shape.t3, shape.t4, shape.t5, shape.t7, direction, (shape.t3 + shape.t4) / 2.0, 1.0 / near.turn_rate,
        shape.first_burn_begin, shape.first_burn_end - shape.first_burn_begin, near.programme.last_burn,
    ]  # fmt: skip

    def cost(z: np.ndarray) -> float:
        return SCALE * _propellant(z, vehicle)

    def conditions(z: np.ndarray) -> np.ndarray:
        end = end_of_profile(z, vehicle, transfer.gravity)
        residual = (end - [transfer.distance, 0.0, -transfer.descent, 0.0]) / [FAR, FAST, FAR, FAST]
        return np.concatenate([_find_discontinuities(z, swing), residual])

    z = minimise(cost, conditions, guess, [0.0] * 5 + [-math.inf, -math.inf, 1e-3] + [0.0] * 3)
    if z is None or not _is_ordered(z):
        return None
    return FiniteProfile(
        times=tuple(z[:5].tolist()),
        tangent=tuple(z[5:8].tolist()),
        burns=tuple(z[8:].tolist()),
        propellant_fraction=_propellant(z, vehicle),
    )


def pitch_of_profile(z: np.ndarray, swing: float, t: np.ndarray) -> np.ndarray:
    """Return pitch (rad) at times (s); ``z``: t2, t3, t4, t5, t7 and the tangent law; ``swing`` in rad/s2."""
    t2, t3, t4, t5, t7, direction, nearest, scale = z[:8]
    t1, last = t2 / 2.0, (t7 - t5) / 2.0
    curves = [
        -swing * t**2 / 2.0,
        swing * ((t2 - t) ** 2 / 2.0 - t1**2),
        direction + np.arctan((t - nearest) / scale) - HALF,
        -swing * ((t5 - t) ** 2 / 2.0 - last**2),
    ]
    return HALF + np.select([t <= t1, t <= t3, t <= t4, t <= t7 - last], curves, swing * (t7 - t) ** 2 / 2.0)


def end_of_profile(z: np.ndarray, vehicle: Vehicle, gravity: float) -> np.ndarray:
    """Return x, x', y, y' (m, m/s) at the end, by Gauss-Legendre quadrature between the switches."""
    t2, t3, t4, t5, t7 = z[:5]
    begin, end, last = z[8], z[8] + z[9], z[10]
    switches = np.sort(np.clip([0.0, t2 / 2.0, t3, t4, (t5 + t7) / 2.0, begin, end, t7 - last, t7], 0.0, t7))
    counts = np.maximum(1, np.ceil(np.diff(switches) / LONGEST)).astype(int)
    spans = zip(switches[:-1], switches[1:], counts, strict=True)
    edge = np.concatenate([*(np.linspace(low, high, count + 1)[:-1] for low, high, count in spans), [t7]])
    step, middle = np.diff(edge)[:, np.newaxis], (edge[1:] + edge[:-1]) / 2.0
    full = ((middle > begin) & (middle < end)) | (middle > t7 - last)
    thrust = np.where(full, vehicle.full, vehicle.least)[:, np.newaxis]
    flow = thrust / vehicle.exhaust_speed
    before = np.cumsum(flow * step, axis=0) - flow * step
    time = edge[:-1, np.newaxis] + step * NODES
    impulse = step * WEIGHTS * thrust / (1.0 - before - flow * step * NODES)
    angle = pitch_of_profile(z, vehicle.angular_acceleration, time)
    along, up = impulse * np.cos(angle), impulse * np.sin(angle)
    left = t7 - time
    return np.array([
        np.sum(left * along), np.sum(along), np.sum(left * up) - gravity * t7**2 / 2.0, np.sum(up) - gravity * t7
    ])  # fmt: skip


def _propellant(z: np.ndarray, vehicle: Vehicle) -> float:
    full = z[9] + z[10]
    return float((vehicle.least * z[4] + (vehicle.full - vehicle.least) * full) / vehicle.exhaust_speed)


def _find_discontinuities(z: np.ndarray, swing: float) -> np.ndarray:
    """Return the jumps of pitch and of its rate where the tangent law begins and ends."""
    t2, t3, t4, t5, t7, direction, nearest, scale = z[:8]
    before = swing * ((t3 - t2) ** 2 / 2.0 - t2**2 / 4.0), swing * (t3 - t2)
    after = swing * ((t7 - t5) ** 2 / 4.0 - (t5 - t4) ** 2 / 2.0), swing * (t5 - t4)
    gaps = []
    for t, (angle, rate) in ((t3, before), (t4, after)):
        gaps += [
            angle + HALF - direction - math.atan((t - nearest) / scale),
            (rate - scale / (scale**2 + (t - nearest) ** 2)) / TURNING,
        ]
    return np.array(gaps)


def _is_ordered(z: np.ndarray) -> bool:
    """Return True if the times are in the order of the profile."""
    t2, t3, t4, t5, t7 = z[:5]
    order = [0.0, t2 / 2.0, t3, t4, (t5 + t7) / 2.0, t7]
    return bool(np.all(np.diff(order) >= 0.0) and z[8] + z[9] <= t7 - z[10])
