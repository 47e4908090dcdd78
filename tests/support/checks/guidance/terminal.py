"""Shared code of the truths of terminal guidances: samples of trajectories, and the record of all outputs.

A law is a function of one sample and of the samples before; the active command, the remaining time and the end of a
flight follow from the record of its solutions. Adopted from the interface: the statuses, and the outputs without a
command.
"""

from dataclasses import dataclass

import numpy as np

from tests.support.checks.check import Check
from tests.support.flights.linear_thrust import GRAVITY, UP, linear_thrust

STEP = 8.0  # s
FOREVER = 1e9  # s
EXACT = ("command_time", "status", "finished", "clamp_count", "limit", "choices")
WITHOUT_COMMAND = (
    "thrust_direction",
    "command_time",
    "clamp_count",
    "glide_margin",
    "predicted_propellant",
)  # with no command
GOOD, CLAMPED, NOT_CONVERGED, NO_SOLUTION = range(4)


@dataclass(frozen=True)
class Solution:
    """A law's answer: time-to-go (s), thrust over mass (m/s2), its direction and the derivative of that (1/s)."""

    time: float
    size: float = 0.0
    direction: tuple | np.ndarray = (0.0, 0.0, 1.0)
    rate: tuple | np.ndarray = (0.0, 0.0, 0.0)
    status: int = GOOD
    clamps: int | None = None  # arcsines clamped, of methods that have them
    extras: dict | None = None  # other outputs of the law


def path_of(position, velocity, time, step=STEP):
    """Return positions and velocities every step under the thrust a0 + a1 t that arrives after
    ``time``, to before the end."""
    a0, a1 = linear_thrust(position, velocity, time)
    t = step * np.arange(int(time / step) + 1)[:, None]
    fall = GRAVITY * UP
    positions = position + t * velocity + t**2 / 2.0 * (a0 - fall) + t**3 / 6.0 * a1
    return positions, velocity + t * (a0 - fall) + t**2 / 2.0 * a1


def disturb(path, seed, fraction=1e-3):
    """Return the path with errors that fade with the remaining distance, for guidance to correct."""
    random = np.random.default_rng(seed)
    return tuple(rows * (1.0 + fraction * random.uniform(-1.0, 1.0, rows.shape)) for rows in path)


def burn_end(times, left, horizon):
    """Return the sample of the last burn, the first with no more than ``horizon`` left, or the number of samples."""
    late = np.flatnonzero(left <= horizon)
    return late[0] if len(late) else len(times)


def fly(times, solutions, direction, last_burn=None):
    """Return outputs of the slot over one flight, from its first sample on.

    ``direction`` is that of the command before. ``last_burn`` (s): the last command is timed, and issued with no more
    than that left; None: the flight stops with the first sample, after its first, that has less than a cycle left.
    """
    count = len(times)
    solved = np.array([solution.status < NOT_CONVERGED for solution in solutions])
    planned = np.array([solution.time for solution in solutions])
    commands = solved & (planned > 0.0)
    begun = np.logical_or.accumulate(commands)
    in_force = np.maximum.accumulate(np.where(commands, np.arange(count), 0))
    # the last time-to-go that was solved for, counted down
    known = np.maximum.accumulate(np.where(solved & begun, np.arange(count), 0))
    left = np.where(begun, planned[known] - (times - times[known]), 0.0)
    status = np.array([solution.status for solution in solutions])
    status = np.where(~begun & (status < NOT_CONVERGED), NO_SOLUTION, status)
    size = np.array([solution.size for solution in solutions])[in_force] * begun
    command_time = np.where(begun, times[in_force], times[0])
    burn = np.full(count, FOREVER)
    later = np.arange(count) > 0
    if last_burn is None:
        end = burn_end(times, np.where(begun & later, left, np.inf), np.nextafter(STEP, 0.0))
        stop = np.minimum(np.arange(count), end)
        finished = np.arange(count) >= end
        size, left, status, command_time = np.where(finished, 0.0, size), left[stop], status[stop], command_time[stop]
    else:
        end = burn_end(times, np.where(begun, left, np.inf), last_burn)
        stop = np.minimum(np.arange(count), end)
        stop_time = times[end] + left[end] if end < count else np.inf
        finished = np.arange(count) >= burn_end(times, stop_time - times - 1e-9 * STEP, 0.0)
        finished &= np.arange(count) > end
        burn = np.where(np.arange(count) >= end, stop_time - command_time[stop], burn)
        burn[0] = left[0] if commands[0] else burn[0]
        left = np.where(np.arange(count) > end, stop_time - times, left)
        size, status, command_time = size[stop], status[stop], command_time[stop]
        last = times[np.argmax(finished)]
        size, left, burn = (np.where(finished, 0.0, values) for values in (size, left, burn))
        command_time = np.where(finished, last, command_time)
    choice, is_set = in_force[stop], begun[stop, None]
    return {
        "thrust_acceleration": size,
        "thrust_direction": np.where(
            is_set, np.array([solution.direction for solution in solutions])[choice], direction
        ),
        "thrust_direction_rate": np.array([solution.rate for solution in solutions])[choice] * is_set,
        "command_time": command_time,
        "burn_duration": burn,
        "time_to_go": left,
        "status": status,
        "finished": finished,
        **{
            name: np.array([solution.extras[name] for solution in solutions])[stop]
            for name in solutions[0].extras or ()
        },
    }


def check_of(truth, flights, law, parameters, last_burn=None, tolerance=1e-12):
    """Return the check of flights, each a list of positions and velocities, with an inactive row between them.

    ``law`` makes a `Solution` of position, velocity and a dictionary that is new in every flight.
    """
    inputs, records, first, direction, clamped = [], [], 0, UP, 0
    for number, flight in enumerate(flights):
        observed = (
            [flight[0], *flight] if number == 0 else flight
        )  # the first row is sampled at the start, and a step later
        memory = {}
        solutions = [law(*state, memory) for state in observed]
        outputs = fly(STEP * (first + np.arange(len(observed))), solutions, direction, last_burn)
        if solutions[0].clamps is not None:
            counts = clamped + np.cumsum([solution.clamps for solution in solutions])
            clamped = counts[-1]
            outputs["clamp_count"] = counts
        idle = {name: np.zeros_like(values[:1]) for name, values in outputs.items()}
        direction = outputs["thrust_direction"][-1]
        idle |= {name: outputs[name][-1:] for name in WITHOUT_COMMAND if name in outputs}
        idle["burn_duration"] = np.array([FOREVER])
        records += [outputs, idle]
        inputs += [(*state, True) for state in flight] + [(*flight[-1], False)]
        first += len(observed) + 1
    outputs = {name: np.concatenate([record[name] for record in records]) for name in records[0]}
    position, velocity, active = (np.array(rows) for rows in zip(*inputs, strict=True))
    rows = len(active)
    exact = dict.fromkeys(EXACT, (0.0, 0.0))
    return Check(
        truth=truth,
        step=STEP,
        inputs={"position": position, "velocity": velocity, "active": active},
        outputs={name: values[:rows] for name, values in outputs.items()},
        tolerances=dict.fromkeys(outputs, (tolerance, tolerance)) | exact,
        parameters=parameters,
    )
