"""Truth of the landing sequencer: a prescribed sequence, produced by the inputs of `landing_record`."""

import numpy as np

from tests.support.checks.check import STEP, Check
from tests.support.checks.sequencing import landing_record as seen
from tests.support.checks.sequencing.landing_record import BURNS, CENTRE, CYCLE, CYCLES, MASS, RADIUS, THRUST, TIME

STARTS = [0, 5, 11, 20, 26, 30, 35, 37, 41]  # cycles in which phases 1 to 9 begin
STATUSES = {3: 11, 4: 20, 2: 22, 1: 26, 5: 27, 7: 39, 6: 41}  # status: cycle from which it holds
PLANS = {20: 4, 26: 2, 27: 2, 30: 1, 35: 3, 37: 1, 39: 5}  # cycle of a request: mode
LOOKAHEAD, SETTLING, HEIGHTS, LOWEST_HOVER, MOVE_OVER_DROP = 8.0, 0.5, (2400.0, 100.0, 4.0), 300.0, 1.3
NUMBERS = np.arange(CYCLES)


def latest(changes, before):
    """Return by cycle the last change, or the value ``before`` it."""
    keys = sorted(changes)
    values = np.array([before, *(changes[key] for key in keys)])
    return values[np.searchsorted(keys, NUMBERS, side="right")]


def on_sphere(position, height=0.0):
    """Return the point above the Moon by a height (m), on the vertical of a position."""
    return CENTRE + (RADIUS + height) * (position - CENTRE) / np.linalg.norm(position - CENTRE)


def sites():
    """Return site and target by cycle: braking ends elsewhere, a move is shortened, then dropped, another accepted."""
    position, velocity = seen.fly_on(19, None)
    ahead = position + LOOKAHEAD * velocity
    assert np.linalg.norm(ahead - CENTRE) - RADIUS < LOWEST_HOVER
    move, third = np.hstack([seen.MOVES, np.zeros((2, 1))])
    first, largest_move = on_sphere(ahead), MOVE_OVER_DROP * (HEIGHTS[0] - HEIGHTS[1])
    assert np.linalg.norm(move) > largest_move
    second = on_sphere(first + largest_move * move / np.linalg.norm(move))
    site = latest({20: first, 26: second, 27: first, 35: on_sphere(first + third)}, np.zeros(3))
    height = latest({20: LOWEST_HOVER, 26: HEIGHTS[1], 35: HEIGHTS[2]}, 0.0)
    targets = np.array([on_sphere(*pair) for pair in zip(site, height, strict=True)])
    return site, np.where(NUMBERS[:, None] < 20, 0.0, targets)


def own_command(position, velocity):
    """Return by cycle the command against the horizontal velocity until the coast is over,
    upwards from contact on, turning with both."""
    centred = position - CENTRE
    turning = np.cross(centred, velocity) / (centred**2).sum(axis=1)[:, None]
    up = centred / np.linalg.norm(centred, axis=1)[:, None]
    backwards = np.cross(up, turning)
    backwards = backwards / np.linalg.norm(backwards, axis=1)[:, None]
    direction = np.where(NUMBERS[:, None] < 20, backwards, up)
    decided = np.minimum(NUMBERS - 1, 42)  # from the inputs of the cycle before, until all is finished
    gives = (decided >= 0) & ((NUMBERS < 11) | (NUMBERS >= 41))
    burns = np.zeros(CYCLES)
    burns[2:5] = BURNS[1] + CYCLE, BURNS[2], BURNS[3]
    return {
        "thrust_acceleration": np.where(burns > 0.0, THRUST / MASS[decided], 0.0),
        "thrust_direction": np.where(gives[:, None], direction[decided], 0.0),
        "thrust_direction_rate": np.where(gives[:, None], np.cross(turning, direction)[decided], 0.0),
        "command_time": TIME[np.where(NUMBERS < 41, decided.clip(0, 10), decided)],
        "burn_duration": burns,
    }


def landing_sequencer():
    """Check nine phases and all statuses but two, 8 and 9.

    The deorbit ignites on time and holds its end. The coast falls, once not to the ground, just short of its range,
    once not low enough, then for good. The braking waits for a command and for the axis, is without a solution for a
    while and ends elsewhere. A plan that was not requested and inputs between two cycles do not count. Hover 2 does not
    settle, the probe does not touch.
    """
    site, target = sites()
    phase = np.searchsorted(STARTS, NUMBERS, side="right")
    plan = np.searchsorted(sorted(PLANS), NUMBERS, side="right")
    inputs = seen.record(target, plan)
    engine_on = ((NUMBERS >= 2) & (NUMBERS < 5)) | ((NUMBERS >= 14) & (NUMBERS < 41))
    quiet = [not engine_on[max(0, j - 2) : j + 1].any() for j in NUMBERS]  # SETTLING is two cycles
    source = np.array([1, 1, 2, 3, 3, 3, 3, 3, 1])[phase - 1]
    begun = NUMBERS[:, None] >= STARTS
    come = NUMBERS[:, None] >= [STATUSES[status] for status in sorted(STATUSES)]
    by_cycle = {
        "phase": phase,
        "braking_active": source == 2,
        "hover_active": source == 3,
        "hover_mode": latest({**PLANS, 41: 0}, 0),
        "plan_number": plan,
        "target_position": target,
        "site": site,
        "source": source,
        "engine_on": engine_on,
        **own_command(inputs["estimated_position"][::2], inputs["estimated_velocity"][::2]),
        "free_flight": np.array(quiet) & (phase <= 3) & (TIME >= SETTLING),
        "status": (come * sorted(STATUSES)).max(axis=1),
        "status_flags": come @ 2 ** (np.array(sorted(STATUSES)) - 1),
        "status_time": np.hstack(
            [np.where(come, TIME[[STATUSES[s] for s in sorted(STATUSES)]], -1.0), -np.ones((CYCLES, 2))]
        ),
        "phase_time": np.where(begun, TIME[STARTS], -1.0),
        "phase_mass": np.where(NUMBERS[:, None] > STARTS, MASS[STARTS], 0.0),
        "finished": NUMBERS >= 43,
    }
    rounded = {"target_position": 2e-9, "site": 2e-9, "burn_duration": 1e-11}
    computed = ("thrust_acceleration", "thrust_direction", "thrust_direction_rate")
    return Check(
        truth="a flight written beforehand; geometry by numpy",
        step=STEP,
        inputs=inputs,
        outputs={name: np.repeat(rows, 2, axis=0)[:-1] for name, rows in by_cycle.items()},
        tolerances={
            **dict.fromkeys(by_cycle, (0.0, 0.0)),
            **dict.fromkeys(computed, (1e-13, 0.0)),
            **{name: (absolute, 0.0) for name, absolute in rounded.items()},
        },
        parameters=PARAMETERS,
    )


PARAMETERS = {
    "start_phase": np.array(1),
    "cycle": CYCLE,
    "moon_radius": RADIUS,
    "gravitational_parameter": seen.MU,
    "minimum_thrust": 340.0,
    "maximum_thrust": 10.0 * THRUST,
    "deorbit_throttle": 0.1,
    "dry_mass": seen.DRY_MASS,
    "preliminary_altitude": HEIGHTS[0],
    "final_altitude": HEIGHTS[1],
    "cutoff_altitude": HEIGHTS[2],
    "settling_time": SETTLING,
    "braking_range": seen.BRAKING_RANGE,
    "pericentre_altitude": seen.PERICENTRE,
    "hold_time": 0.4,
    "lowest_coast": seen.LOWEST_COAST,
    "coast_clearance": seen.CLEARANCE,
    "coast_patience": 0.5,
    "pointing_tolerance": seen.TOLERANCE,
    "handover_time_to_go": seen.TIME_TO_GO,
    "solution_patience": 0.75,
    "far_range": seen.FAR,
    "slow_speed": seen.SLOW,
    "hover_time": 0.5,
    "hover_patience": 1.25,
    "settled_speed": seen.SETTLED_SPEED,
    "settled_distance": seen.SETTLED_DISTANCE,
    "reach_over_drop": MOVE_OVER_DROP,
    "second_reach": 67.1,
    "reserve": seen.RESERVE,
    "lookahead": LOOKAHEAD,
    "lowest_hover": LOWEST_HOVER,
    "descent_wait": 0.5,
    "cut_altitude": seen.CUT_ALTITUDE,
}
TRUTHS = {"landing_sequencer": landing_sequencer}
