"""Linear periodic system, as FMUs and as plain recurrences.

Of two coupled double integrators axis 1 is controlled at every second step and axis 2 at every third, so the system has
a period of six steps. The recurrences are written here independently of the FMUs.
"""

from __future__ import annotations

import numpy as np

from perilune.analysis.stability.point.lifted import LiftedModel, SampledChannel
from perilune.analysis.stability.request.channels import Channel
from tests.support.builders import component, connection, document, inline, system

STEP, COUPLING = 0.2, 0.4
EVERY = (2, 3)  # steps of each axis' control
HYPERPERIOD = 6
PROPORTIONAL, DERIVATIVE = (0.5, 0.7), (0.8, 1.1)
STATES = 10  # positions, velocities, u of each controller's last sample, commands, commands as exchanged
SETTLED = 1000  # points after which what the start left is below rounding
SAMPLES = HYPERPERIOD // EVERY[0], HYPERPERIOD // EVERY[1]


def description() -> str:
    """Return the description: components `first` and `second` control `plant`."""
    controls = [
        component(
            name,
            "difference",
            "input u Real; output y Real",
            inline(
                f"proportional=Real:{PROPORTIONAL[axis]}; derivative=Real:{DERIVATIVE[axis]}; "
                f"sample_period=Real:{EVERY[axis] * STEP}"
            ),
        )
        for axis, name in enumerate(("first", "second"))
    ]
    vectors = "; ".join(f"input u[{i}] Real; output position[{i}] Real" for i in (1, 2))
    plant = component("plant", "held_pair", vectors, inline(f"coupling=Real:{COUPLING}"))
    wires = "".join(
        connection(f"{name}.y", f"plant.u[{i}]") + connection(f"plant.position[{i}]", f"{name}.u")
        for i, name in ((1, "first"), (2, "second"))
    )
    return document(system(*controls, plant, connections=wires), stop=30.0, step=STEP)


def advance(state: np.ndarray, point: int, added: np.ndarray, opened: tuple[int, ...] = ()) -> np.ndarray:
    """Return the memory (STATES, n) at a communication point from that at the one before.

    ``added`` (2, n) goes onto the commands; those of the axes in ``opened`` are not fed back.
    """
    position, velocity, last, command, exchanged = (part.copy() for part in np.split(state, 5))
    force = np.array([[1.0, COUPLING], [-COUPLING, 1.0]]) @ exchanged
    position += STEP * velocity + 0.5 * STEP**2 * force
    velocity += STEP * force
    for axis in (0, 1):
        if point % EVERY[axis] == 0:
            rate = (position[axis] - last[axis]) / (EVERY[axis] * STEP)
            command[axis] = -(PROPORTIONAL[axis] * position[axis] + DERIVATIVE[axis] * rate)
            last[axis] = position[axis]
        exchanged[axis] = added[axis] + (0.0 if axis in opened else command[axis])
    return np.concatenate([position, velocity, last, command, exchanged])


def hyperperiod(opened: tuple[int, ...] = ()) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the map of six steps from the point before a common sample: memory and samples
    added to memory, u and v."""
    inputs = sum(SAMPLES)
    state = np.hstack([np.eye(STATES), np.zeros((STATES, inputs))])
    u: list[list[np.ndarray]] = [[], []]
    v: list[list[np.ndarray]] = [[], []]
    for point in range(HYPERPERIOD):
        added = np.zeros((2, STATES + inputs))
        for axis, first in ((0, STATES), (1, STATES + SAMPLES[0])):
            added[axis, first + point // EVERY[axis]] = 1.0
        state = advance(state, point, added, opened)
        for axis in (0, 1):
            if point % EVERY[axis] == 0:
                v[axis].append(state[6 + axis])
                u[axis].append(state[8 + axis])
    return state, np.array(u[0] + u[1]), np.array(v[0] + v[1])


def exact_model() -> LiftedModel:
    """Return the lifted model with a port at each axis' command."""
    state, u, v = hyperperiod()
    ports = tuple(
        SampledChannel(channel, EVERY[axis] * STEP, axis * SAMPLES[0], SAMPLES[axis])
        for axis, channel in enumerate(
            Channel(name, name, (f"{name}.y",), None, None, every, None, None)
            for name, every in zip(("first", "second"), EVERY, strict=True)
        )
    )
    at = slice(None, STATES), slice(STATES, None)
    return LiftedModel(
        a=state[:, at[0]],
        b=state[:, at[1]],
        cu=u[:, at[0]],
        du=u[:, at[1]],
        cv=v[:, at[0]],
        dv=v[:, at[1]],
        names=tuple(map(str, range(STATES))),
        period=HYPERPERIOD * STEP,
        ports=ports,
    )


def flown_response(axis: int, cycles: int, samples: int) -> complex:
    """Measure L of one axis at ``cycles`` in ``samples`` of its samples: -V/U of a flight with
    a wave added, settled first."""
    every, window = EVERY[axis], HYPERPERIOD * samples  # points: whole waves and whole hyperperiods
    angle = 2.0 * np.pi * cycles / samples
    state = np.zeros((STATES, 1), dtype=complex)
    u, v = [], []
    for point in range(window * (1 + -(-SETTLED // window))):
        wave = np.exp(1j * angle * (point // every))
        added = np.zeros((2, 1), dtype=complex)
        added[axis] = wave
        state = advance(state, point, added)
        if point % every == 0:
            v.append(state[6 + axis, 0] / wave)
            u.append(state[8 + axis, 0] / wave)
    retained = slice(-window // every, None)
    return -np.sum(v[retained]) / np.sum(u[retained])
