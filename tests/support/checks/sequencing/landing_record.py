"""Inputs of the landing sequencer, cycle by cycle, that produce the sequence of `landing`.

Values are just above or below their thresholds. Rows between two cycles contain the inputs of another cycle, and both
contacts, which must have no effect.
"""

import numpy as np

CYCLE, CYCLES = 0.25, 45
TIME = CYCLE * np.arange(CYCLES)
RADIUS, MU = 1.7374e6, 4.9028e12
BRAKING_RANGE, PERICENTRE, THRUST, DRY_MASS = 285e3, 15e3, 500.0, 440.0
CLEARANCE, LOWEST_COAST, TOLERANCE, TIME_TO_GO, FAR, SLOW = 300.0, 12e3, 0.035, 28.0, 5e3, 30.0
SETTLED_SPEED, SETTLED_DISTANCE, CUT_ALTITUDE, RESERVE = 0.5, 10.0, 0.5, 25.0
BURNS = {0: 0.9, 1: 0.9, 2: 0.7, 3: 0.35, 4: 0.8}  # s, what the speed asks for; the last one comes too late
MOVES = np.array([[-2500.0, 1800.0], [60.0, -30.0]])  # m, the one too long, the other just short enough
MASS = np.where(np.arange(CYCLES) < 38, 900.0 - 10.0 * np.arange(CYCLES), DRY_MASS)
CENTRE = np.array([0.0, 0.0, -RADIUS])


def polar(angle, radius, upwards, forwards, sideways=0.0):
    """Return position and velocity at a central angle towards +x, flying to smaller ones,
    ``sideways`` of the plane (m)."""
    up, ahead = np.array([np.sin(angle), 0.0, np.cos(angle)]), np.array([-np.cos(angle), 0.0, np.sin(angle)])
    return CENTRE + radius * up + [0.0, sideways, 0.0], upwards * up + forwards * ahead


def deorbit(cycle):
    """Return a state high by 100 km, horizontally as fast as the burn requests, just before or
    past the angle to begin it."""
    radius, low, off = RADIUS + 1e5, RADIUS + PERICENTRE, 2e4
    distance = np.hypot(radius, off)
    half_axis = (distance + low) / 2.0
    speed = np.sqrt(MU * (2.0 / distance - 1.0 / half_axis)) + BURNS[cycle] * THRUST / MASS[cycle]
    angle = np.pi + BRAKING_RANGE / RADIUS + 0.5 * BURNS[cycle] * speed / distance
    return polar(angle + (1e-7 if cycle == 0 else -1e-7), radius, 0.0, speed, off)


def conic(lowest, height, beyond):
    """Return a fall through an altitude on an ellipse that descends to ``lowest`` (m) on the way to the braking range.

    Its pericentre is ``beyond`` (rad) the braking range, where the way then ends at its lowest; or before it.
    """
    eccentricity = 0.017
    parameter = (RADIUS + lowest) * (1.0 + eccentricity * np.cos(max(beyond, 0.0)))
    anomaly = np.arccos((parameter / (RADIUS + height) - 1.0) / eccentricity)
    speeds = np.sqrt(MU / parameter) * np.array([-eccentricity * np.sin(anomaly), 1.0 + eccentricity * np.cos(anomaly)])
    return polar(BRAKING_RANGE / RADIUS + anomaly - beyond, RADIUS + height, *speeds)


def fly_on(cycle, targets):
    """Return position and velocity of each phase; ``targets``: of the hovers, by cycle."""
    if cycle <= 4:
        return deorbit(cycle)
    if cycle <= 10:
        lowest, height = CLEARANCE + (1.0 if cycle == 6 else -1.0), LOWEST_COAST + (1.0 if cycle == 8 else -1.0)
        return conic(lowest, lowest + 1e-4 if cycle == 6 else height, 0.05 if cycle in (6, 9) else -0.05)
    if cycle <= 19:
        speed = SLOW * (0.9999 if cycle == 19 else 1.0001)
        distance = FAR + (-1.0 if cycle == 17 else 1.0)
        return polar(distance / RADIUS, RADIUS + 308.0, -0.28 * speed, 0.96 * speed)
    if cycle <= 38:
        speed = SETTLED_SPEED * (1.001 if cycle in (23, 31, 32, 33, 34) else 0.999)
        distance = SETTLED_DISTANCE * (1.0001 if cycle == 24 else 0.9999)
        return targets[cycle] + [distance, 0.0, 0.0], speed * np.array([0.0, 0.6, 0.8])
    up = (targets[cycle] - CENTRE) / np.linalg.norm(targets[cycle] - CENTRE)
    height = CUT_ALTITUDE + (1e-3 if cycle == 39 else -1e-3)
    return CENTRE + (RADIUS + height) * up, np.array([0.1, -0.2, -0.9])


def record(targets, requested):
    """Return inputs by rows, two per cycle; ``requested``: number of the requested plan in each cycle."""
    cycles = np.arange(CYCLES)

    def at(*chosen):
        return np.isin(cycles, chosen)

    position, velocity = map(np.array, zip(*(fly_on(cycle, targets) for cycle in cycles), strict=True))
    axis = np.tile([0.6, 0.0, 0.8], (CYCLES, 1))
    angle = TOLERANCE * np.select([cycles < 12, at(12)], [0.0, 1.0001], 0.9999)  # at first by a command of before
    goal = np.column_stack([np.sin(np.arcsin(0.6) + angle), 0.0 * angle, np.cos(np.arcsin(0.6) + angle)])
    by_cycle = {
        "estimated_position": position,
        "estimated_velocity": velocity,
        "mass": MASS,
        "attitude": axis,
        "braking_direction": 1.5 * goal,
        "braking_command_time": np.where(cycles < 12, 0.0, TIME),
        "braking_time_to_go": np.select([at(11, 17), at(18)], [0.0, TIME_TO_GO], TIME_TO_GO * 1.0001),
        "braking_status": 2 * at(11, 12, 13, 17),
        "braking_finished": at(11),
        # the plan before is answered in the cycle after each request
        "hover_plan": np.where(at(20, 27), requested - 1, requested),
        "hover_finished": at(20, 22, 26, 27, 29, 36),
        "hover_status": np.select([at(20), at(21)], [1, 3], 0),
        "predicted_propellant": np.where(at(26, 28), MASS - RESERVE - DRY_MASS + 1e-3, 0.0),
        "probe_contact": np.zeros(CYCLES),
        "ground_contact": at(42),
        "redesignation_1": np.where(at(25)[:, None], MOVES[0], [10.0, 20.0]),
        "redesignation_2": np.where(at(34)[:, None], MOVES[1], [500.0, 20.0]),
    }
    between = {name: np.roll(rows, 7, axis=0) for name, rows in by_cycle.items()}
    between |= {name: np.ones(CYCLES) for name in ("probe_contact", "ground_contact", "hover_finished")}
    return {
        name: np.stack([rows, between[name]], axis=1).reshape(2 * CYCLES, *rows.shape[1:])[:-1]
        for name, rows in by_cycle.items()
    }
