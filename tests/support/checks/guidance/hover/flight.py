"""Inputs of the check of hover guidance: a dozen plans, late samples, rows between samples."""

from types import SimpleNamespace

import numpy as np

from tests.support.checks.check import Check
from tests.support.checks.guidance.hover.law import Law
from tests.support.checks.guidance.hover.plan import CAPTURE, DESCEND, HOLD, IDLE, PROGRAMME, SLOWLY
from tests.support.checks.guidance.hover.programme import VERTICAL, WITH_FIRST_BURN, WITHOUT_FIRST_BURN
from tests.support.checks.guidance.hover.vehicle import (
    IMPULSE,
    LAG,
    MAXIMUM,
    MINIMUM,
    PLANNED_MAXIMUM,
    PLANNED_MINIMUM,
    SLOW,
    SWING,
)

STEP, CYCLE = 1.5, 1.875  # s
EXACT = ("answered_plan", "burn_duration", "command_time", "finished", "plan_kind", "plan_time", "saturated", "status")
UP = np.array([0.0, 0.0, 1.0])

UNDER_WAY = {"velocity": (5.0, -1.0, -3.0), "velocity_increment": (0.1, 0.0, 2.4), "angular_rate": (0.01, -0.02, 0.0)}
UNPOWERED = {
    "velocity": (5.0, 9.0, -9.0),
    "velocity_increment": (0.0, 0.0, 0.1),
    "attitude": (0.6, 0.0, 0.8),
    "angular_rate": (0.0, 0.6, 0.0),
}

# Mode, plan number, samples, kind of programme, target, start; further inputs at the start.
PLANS = (
    (PROGRAMME, 1, 1, None, (0.0, 0.0, 0.0), (5.0, 6.0, 7.0), {"active": False}),
    (PROGRAMME, 1, 11, WITH_FIRST_BURN, (14.8, 6.4, 100.0), (-30.0, 40.0, 170.0), {}),
    (PROGRAMME, 2, 4, WITHOUT_FIRST_BURN, (-12.0, 16.0, 100.0), (0.0, 0.0, 170.0), {}),
    (PROGRAMME, 3, 3, None, (20.0, -10.0, 100.0), (0.0, 0.0, 70.0), {}),
    (PROGRAMME, 4, 3, VERTICAL, (0.3, -0.4, 100.0), (0.0, 0.0, 170.0), {}),
    (SLOWLY, 4, 3, None, (12.0, 0.0, 60.0), (0.0, 0.0, 62.0), {}),
    (SLOWLY, 5, 7, None, (1.0, -1.0, 57.0), (0.0, 0.0, 60.0), {}),
    (HOLD, 5, 5, None, (0.0, 10.0, 50.0), (50.0, -20.0, 60.0), {"velocity": (1.0, -2.0, 15.0)}),
    (HOLD, 6, 1, None, (0.0, 10.0, 50.0), (0.0, 10.0, 120.0), {}),
    (HOLD, 7, 1, None, (0.0, 10.0, 50.0), (35.0, 10.0, 50.0), {}),
    (CAPTURE, 7, 4, None, (0.0, 0.0, 50.0), (-30.0, 8.0, 70.0), UNDER_WAY),
    (CAPTURE, 8, 2, None, (0.0, 0.0, 50.0), (-30.0, 8.0, 70.0), UNPOWERED),
    (IDLE, 8, 1, None, (0.0, 0.0, 0.0), (0.0, 0.0, 60.0), {}),
    (DESCEND, 8, 4, None, (2.0, 3.0, 4.0), (2.5, 3.0, 4.0), {"velocity_increment": (0.0, 0.0, 2.0)}),
    (DESCEND, 9, 2, None, (20.0, 0.0, 60.0), (0.0, 0.0, 60.0), {"mass": 2500.0}),
    (HOLD, 10, 1, None, (0.0, 0.0, 60.0), (0.0, 0.0, 120.0), {}),
    (HOLD, 10, 1, None, (0.0, 0.0, 0.0), (0.0, 0.0, 60.0), {"active": False}),
    (HOLD, 10, 2, None, (0.0, 0.0, 60.0), (1.0, 2.0, 61.0), {"velocity": (0.0, 0.0, 5.0)}),
)


def sample_times(count):
    """Return the times of the samples: at multiples of the cycle, moved to the later communication point."""
    return STEP * np.ceil(CYCLE * np.arange(count) / STEP)


def see(law, plan, number, time, elapsed, random):
    """Return the block's inputs at a sample of a plan: a start, or the reference with errors."""
    mode, plan_number, _, _, target, start, others = plan
    observed = SimpleNamespace(
        active=True,
        mode=mode,
        plan_number=plan_number,
        target_position=np.array(target),
        position=np.array(start),
        velocity=np.zeros(3),
        mass=1000.0,
        attitude=UP,
        angular_rate=np.zeros(3),
        velocity_increment=np.round(law.command / 1000.0 * elapsed * random.uniform(0.95, 1.05) * UP, 3),
    )
    if number == 0:
        vars(observed).update({name: np.array(value) if np.ndim(value) else value for name, value in others.items()})
    elif law.plan:
        position, velocity = law.reference(time)
        observed.position = np.round(position + random.normal(0.0, 3.0, 3), 2)
        observed.velocity = np.round(velocity + random.normal(0.0, 0.3, 3), 2)
        observed.mass = 1000.0 - number
        observed.target_position = observed.target_position + 5.0  # that of the start counts
        if mode == HOLD:
            observed.velocity_increment = observed.velocity_increment * number
    return observed


def hover_guidance():
    """Check every mode, kind of plan and status."""
    samples = [(plan, number) for plan in PLANS for number in range(plan[2])]
    times = sample_times(len(samples))
    elapsed = np.diff(times, prepend=-CYCLE)
    random, law = np.random.default_rng(40), Law(CYCLE)
    inputs, outputs = [], []
    for (plan, number), time, span in zip(samples, times, elapsed, strict=True):
        observed = see(law, plan, number, time, span, random)
        outputs.append(law.sample(time, span, observed, plan[3]))
        inputs.append(vars(observed))
    rows = int(times[-1] / STEP) + 1
    unseen = inputs[-1] | {"active": False}
    rows_of_inputs = [unseen] * rows
    for time, values in zip(times, inputs, strict=True):
        rows_of_inputs[max(int(time / STEP) - 1, 0)] = values
    latest = np.searchsorted(times, STEP * np.arange(rows), side="right") - 1
    columns = {name: np.array([values[name] for values in outputs])[latest] for name in outputs[0]}
    outcomes = {(0, 0), (0, 3), (1, 0), (2, 0), (3, 0), (4, 0), (4, 1), (4, 2)}
    assert set(zip(columns["plan_kind"], columns["status"], strict=True)) == outcomes
    assert set(columns["saturated"]) == set(columns["finished"]) == {False, True}
    return Check(
        truth="root finding on the paper's equations by scipy, polynomials by their ends, the law by matrices",
        step=STEP,
        inputs={name: np.array([values[name] for values in rows_of_inputs]) for name in rows_of_inputs[0]},
        outputs=columns,
        tolerances=dict.fromkeys(columns, (1e-9, 1e-9)) | dict.fromkeys(EXACT, (0.0, 0.0)),
        parameters={
            "specific_impulse": IMPULSE,
            "maximum_thrust": MAXIMUM,
            "minimum_thrust": MINIMUM,
            "planned_maximum": PLANNED_MAXIMUM,
            "planned_minimum": PLANNED_MINIMUM,
            "planned_angular_acceleration": SWING,
            "slow_speed": SLOW[0],
            "engine_lag": LAG,
            "sample_period": CYCLE,
        },
    )
