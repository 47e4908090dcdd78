"""Simplified programme of a hover transfer, computed by the kernels of the FMUs, with its path and parameter sweeps."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ....fmus_src.mathlib.hover import motion as hover_motion
from ....fmus_src.mathlib.hover import programme as hover_programme
from ....fmus_src.mathlib.hover import shape as hover_shape
from ....fmus_src.mathlib.hover.motion import HoverVehicle
from ....fmus_src.mathlib.hover.shape import HoverProgramme, HoverShape
from ....fmus_src.mathlib.hover.solution import PlanKind, propellant_fraction
from ..trajectories.path import PlannedPath
from ..trajectories.vehicle import Transfer, Vehicle

STEP = 0.25  # s, step of a path
DURATIONS = (0.84, 1.22, 27)  # relative to the best: from, to, count
DISTANCES = (1.6, 25)  # relative to the requested one: to, count


@dataclass(frozen=True)
class Programme:
    """Programme of a transfer, with the vehicle's capability that the plan may use."""

    vehicle: Vehicle
    transfer: Transfer
    kind: str
    programme: HoverProgramme

    @property
    def times(self) -> tuple[float, ...]:
        """Times t2, t5, w, tp and t7, s."""
        return self.programme.elements()

    @property
    def duration(self) -> float:
        """Duration t7, s."""
        return self.programme.t7

    @property
    def propellant_fraction(self) -> float:
        return propellant_fraction(self.programme, kernel_vehicle(self.vehicle, self.transfer))

    @property
    def threshold(self) -> float | None:
        """Paper's k: the first burn lasts while thrust is turned over k times its largest turn; None for vertical."""
        first = 0.5 * self.programme.t2
        return 1.0 - self.programme.width**2 / (2.0 * first**2) if first > 0.0 else None

    @property
    def burns(self) -> list[tuple[float, float]]:
        """Begin and end (s) of each burn at full thrust."""
        shape = self.shape()
        burns = [(shape.first_burn_begin, shape.first_burn_end), (shape.last_burn_begin, shape.t7)]
        return [(begin, end) for begin, end in burns if end > begin]

    @property
    def extremes(self) -> tuple[float, float]:
        """Least and largest pitch (rad), the angle of thrust from the horizontal towards the target."""
        shape, swing = self.shape(), self.vehicle.angular_acceleration
        return 0.5 * math.pi - swing * shape.t1**2, 0.5 * math.pi + swing * shape.last**2

    @property
    def turn_rate(self) -> float:
        """Largest rate of pitch, rad/s."""
        return self.vehicle.angular_acceleration * self.shape().d

    def shape(self) -> HoverShape:
        return hover_shape.shape_of(self.programme, self.vehicle.angular_acceleration).shape

    def states(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return rows of x, x', y, y' (m, m/s) and rows of pitch, its rate (rad, rad/s) and propellant at times."""
        shape, vehicle = self.shape(), kernel_vehicle(self.vehicle, self.transfer)
        motion, remainder = np.zeros((time.size, 4)), np.zeros((time.size, 3))
        for index, value in enumerate(map(float, time)):
            state = hover_motion.motion(shape, vehicle, value)
            motion[index] = state.x, state.x_rate, state.y, state.y_rate
            turn = hover_shape.pitch(shape, self.vehicle.angular_acceleration, value)
            remainder[index] = 0.5 * math.pi + turn.deviation, turn.rate, hover_motion.propellant(shape, vehicle, value)
        return motion, remainder

    def thrust(self, time: np.ndarray) -> np.ndarray:
        """Return the thrust (N) at times (s)."""
        shape = self.shape()
        full = np.array([hover_shape.full_thrust(shape, float(value)) for value in time])
        return np.where(full, self.vehicle.maximum_thrust, self.vehicle.minimum_thrust)

    def path(self, engine: float) -> PlannedPath:
        """Return the path, with all switches among its times; ``engine`` is the thrust (N) at full throttle."""
        even = np.linspace(0.0, self.duration, max(2, math.ceil(self.duration / STEP)) + 1)
        switches = [time for burn in self.burns for time in burn]
        time = np.unique(np.clip([*even, *switches], 0.0, self.duration))
        middle = (time[1:] + time[:-1]) / 2.0
        motion, remainder = self.states(time)
        return PlannedPath(
            time=time,
            position=motion[:, [0, 2]],
            velocity=motion[:, [1, 3]],
            propellant=remainder[:, 2],
            throttle=self.thrust(middle) / engine,
            pitch=self.states(middle)[1][:, 0],
        )


def find_programme(vehicle: Vehicle, transfer: Transfer, duration: float | None = None) -> Programme | None:
    """Return the programme of least propellant, optionally with a ``duration`` (s), or None if there is none."""
    kernel = kernel_vehicle(vehicle, transfer)
    if duration is None:
        planned = hover_programme.programme(transfer.distance, -transfer.descent, kernel)
    else:
        place = transfer.distance, -transfer.descent
        planned = hover_programme.programme_of_duration(*place, duration, kernel)
    if planned.kind == PlanKind.NONE:
        return None
    return Programme(vehicle, transfer, PlanKind.meanings[planned.kind], planned.programme)


def sweep_duration(best: Programme) -> tuple[np.ndarray, np.ndarray]:
    """Return durations (s) around the best and their propellant fractions, nan where there is no programme."""
    low, high, count = DURATIONS
    durations = np.unique([*(best.duration * np.linspace(low, high, count)), best.duration])
    programmes = [find_programme(best.vehicle, best.transfer, float(value)) for value in durations]
    return durations, _fractions(programmes)


def sweep_distance(best: Programme) -> tuple[np.ndarray, np.ndarray]:
    """Return distances (m) from 0 to beyond the programme's distance, and the least propellant fraction of each."""
    farthest, count = DISTANCES
    wide = farthest * max(best.transfer.distance, 0.2 * best.transfer.descent)
    distances = np.unique([*np.linspace(0.0, wide, count), best.transfer.distance])
    transfers = [replace(best.transfer, distance=float(value)) for value in distances]
    return distances, _fractions([find_programme(best.vehicle, transfer) for transfer in transfers])


def _fractions(programmes: list[Programme | None]) -> np.ndarray:
    return np.array([np.nan if programme is None else programme.propellant_fraction for programme in programmes])


def kernel_vehicle(vehicle: Vehicle, transfer: Transfer) -> HoverVehicle:
    return HoverVehicle(
        full=vehicle.full,
        least=vehicle.least,
        exhaust=vehicle.exhaust_speed,
        gravity=transfer.gravity,
        swing=vehicle.angular_acceleration,
    )
