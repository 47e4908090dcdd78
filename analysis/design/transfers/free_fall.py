"""Alternative final phase of a transfer: the lander turns to the vertical in free fall and brakes once more.

Pitch follows the simplified programme, but the last turn from t5 to t7 takes place with the engine off: the braking
burn ends at t5, at rest and tilted, and after t7 a vertical burn at full thrust stops the fall. Alternatively the
braking burn ends later, after the turn has begun. Source of both variants: Huang 2017, after Likhachev, Sikharulidze
and Fedotov 2013; the programme is ours.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ....fmus_src.mathlib.hover import motion as hover_motion
from ....fmus_src.mathlib.hover import shape as hover_shape
from ....fmus_src.mathlib.hover.shape import HoverProgramme
from ..trajectories.vehicle import Transfer, Vehicle
from .nonlinear import minimise
from .programme import Programme, kernel_vehicle

FAR, FAST = 100.0, 5.0  # m and m/s of equal weight
SCALE = 1e3  # scale of the propellant fraction
SHORTEST = 0.01  # s, least duration of the turn
SHORTEST_BURN = 1e-3  # s
NO_SHAPE = 1e3  # value of the conditions if the times have no shape


@dataclass(frozen=True)
class FreeFallProgramme:
    """Programme with a free fall; ``times`` are t2, t5, w and t7 (s) as in the simplified programme, and tp.

    The time tp is the duration of the braking burn. ``fall`` (s) is the time with the engine off, until t7, and
    ``last_burn`` (s) the duration of the burn that follows. ``drop`` (m) is the height lost during both;
    ``propellant_fraction`` is the total. ``full_thrust`` contains begin and end (s) of each burn.
    """

    times: HoverProgramme
    fall: float
    last_burn: float
    drop: float
    propellant_fraction: float
    full_thrust: tuple[tuple[float, float], ...]

    @property
    def duration(self) -> float:
        """Duration until rest after the last burn, s."""
        return self.times.t7 + self.last_burn


def find_free_fall(near: Programme, begun: float = 0.0) -> FreeFallProgramme | None:
    """Return the programme of least propellant for the vehicle and transfer of a simplified programme, or None.

    ``begun``: fraction of the turn's duration, t7 - t5, that has passed when the braking burn ends.
    """
    vehicle, transfer = near.vehicle, near.transfer
    shape = near.shape()
    if not shape.t7 > shape.t5:
        return None  # nothing to turn

    def conditions(z: np.ndarray) -> np.ndarray:
        flown = _fly(z, begun, vehicle, transfer)
        return np.full(4, NO_SHAPE) if flown is None else flown[1]

    def cost(z: np.ndarray) -> float:
        flown = _fly(z, begun, vehicle, transfer)
        return SCALE if flown is None else SCALE * flown[0].propellant_fraction

    burn = near.programme.last_burn
    guess = [shape.t2, shape.t5, max(near.programme.width, 0.1), 0.8 * burn, shape.t7 - shape.t5]
    best = minimise(cost, conditions, guess, [0.0, 0.0, 0.0, 0.0, SHORTEST])
    flown = None if best is None else _fly(best, begun, vehicle, transfer)
    return None if flown is None else flown[0]


def _fly(
    z: np.ndarray, begun: float, vehicle: Vehicle, transfer: Transfer
) -> tuple[FreeFallProgramme, np.ndarray] | None:
    """Return the programme with t2, t5, w, tp and t7 - t5 (s), None if these are infeasible, and its final errors."""
    t2, t5, width, burn, turn = (float(each) for each in z)
    kernel = kernel_vehicle(vehicle, transfer)
    off, fall = t5 + begun * turn, (1.0 - begun) * turn
    pitch = HoverProgramme(t2=t2, t5=t5, width=width, last_burn=burn + fall, t7=t5 + turn)
    planned = hover_shape.shape_of(pitch, vehicle.angular_acceleration)
    if not planned.exists:
        return None
    end = hover_motion.motion(planned.shape, kernel, off)
    spent = hover_motion.propellant(planned.shape, kernel, off)
    stop = stop_falling(vehicle, transfer.gravity, spent, fall)
    if not end.exists or stop is None:
        return None
    last_burn, drop = stop
    residual = np.array([
        (end.x - transfer.distance) / FAR, end.x_rate / FAST,
        (end.y - drop + transfer.descent) / FAR, end.y_rate / FAST,
    ])  # fmt: skip
    times = HoverProgramme(t2=t2, t5=t5, width=width, last_burn=burn, t7=t5 + turn)
    fraction = spent + vehicle.full * last_burn / vehicle.exhaust_speed
    first = planned.shape.first_burn_begin, planned.shape.first_burn_end
    burns = (
        *([first] if first[1] - first[0] > SHORTEST_BURN else []),
        (off - burn, off),
        (t5 + turn, t5 + turn + last_burn),
    )
    return FreeFallProgramme(times, fall, last_burn, drop, fraction, burns), residual


def stop_falling(vehicle: Vehicle, gravity: float, spent: float, fall: float) -> tuple[float, float] | None:
    """Return the duration (s) of the full-thrust burn that stops a fall from rest, and the height (m) lost in total.

    ``fall`` (s) is the duration of the fall, ``spent`` the propellant fraction before. With the mass ratio q = 1 - b t,
    where b is the mass flow over the remaining mass, the burn removes the speed c ln(1/q) - g t. The result is None if
    the thrust is too small.
    """
    speed, flow = vehicle.exhaust_speed, vehicle.full / vehicle.exhaust_speed / (1.0 - spent)

    def left(t: float) -> float:
        return gravity * (fall + t) + speed * math.log1p(-flow * t)

    longest = 0.999 / flow
    if not (speed * flow > gravity and left(longest) < 0.0):
        return None
    burn = float(brentq(left, 0.0, longest, xtol=1e-13))
    ratio = 1.0 - flow * burn
    lifted = speed * (burn + ratio / flow * math.log1p(-flow * burn))
    return burn, gravity * (fall + burn) ** 2 / 2.0 - lifted
