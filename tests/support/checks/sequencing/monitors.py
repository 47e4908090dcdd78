"""Truths of the command switch and of monitors, from complete records. Direct outputs follow one row later."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow

PLAN = 4  # requested hover plan


def unit_vectors(random, rows):
    directions = random.normal(size=(rows, 3))
    return directions / np.linalg.norm(directions, axis=1)[:, None]


def command_switch():
    """Check each source, none, the engine off, a hover plan that is answered two rows late: the last command is
    held."""
    random = np.random.default_rng(281)
    source = np.array([0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 3, 3, 1, 1, 0, 0, 2, 2])
    hover_plan = np.where(np.arange(len(source)) < 9, PLAN - 1, PLAN)
    engine_on = np.ones(len(source), dtype=bool)
    engine_on[[2, 5, 7, 11]] = False
    rows = len(source)
    commands = {
        name: {
            "thrust_acceleration": random.uniform(1.0, 4.0, rows),
            "thrust_direction": unit_vectors(random, rows),
            "thrust_direction_rate": random.normal(0.0, 1e-2, (rows, 3)),
            "command_time": random.uniform(0.0, 1.0, rows),
            "burn_duration": random.uniform(5.0, 9.0, rows),
        }
        for name in ("own", "braking", "hover")
    }
    feed = random.normal(0.0, 1e-3, (rows, 3))
    # the row whose command is in force: the present one, but the last before the hover guidance until it answers
    waits = (source == 3) & (hover_plan != PLAN)
    in_force = np.maximum.accumulate(np.where(waits, 0, np.arange(rows)))
    outputs = {}
    for name, shape in commands["own"].items():
        choices = np.stack([np.zeros_like(shape), *(commands[key][name] for key in ("own", "braking", "hover"))])
        outputs[name] = choices[source[in_force], in_force]
    timing = ("command_time", "burn_duration")
    named = np.maximum.accumulate(np.where(source[in_force] > 0, in_force, 0))  # no source has no time
    for name in timing:
        choices = np.stack([np.zeros(rows), *(commands[key][name] for key in ("own", "braking", "hover"))])
        outputs[name] = choices[source[named], named]
    outputs["thrust_acceleration"] = outputs["thrust_acceleration"] * engine_on
    outputs["angular_acceleration_feed"] = np.where((source[in_force] == 3)[:, None], feed[in_force], 0.0)
    inputs = {f"{key}_{name}": value for key, command in commands.items() for name, value in command.items()}
    return Check(
        truth="selection by row",
        step=STEP,
        inputs={
            "source": source,
            "engine_on": engine_on,
            "plan_number": np.full(rows, PLAN),
            "hover_plan": hover_plan,
            **inputs,
            "hover_angular_acceleration_feed": feed,
        },
        outputs={name: follow(value) for name, value in outputs.items()},
        tolerances=dict.fromkeys(outputs, (0.0, 0.0)),
        parameters={},
    )


def flight_monitor():
    """Check that slow above the band and fast in it are no hand-over; the ground comes after the hand-over."""
    altitude = np.array([900.0, 800.0, 700.0, 600.0, 500.0, 450.0, 400.0, 300.0, 100.0, 0.0, 5.0, 5.0])
    speed = np.array([20.0, 4.0, 4.0, 20.0, 5.0, 4.5, 20.0, 2.0, 2.0, 2.0, 2.0, 2.0])
    handed_over = np.logical_or.accumulate((speed < 5.0) & (altitude >= 400.0) & (altitude <= 650.0))
    ground_contact = np.logical_or.accumulate(altitude <= 0.0)
    assert 0 < handed_over.sum() < len(altitude)
    outputs = {"finished": handed_over | ground_contact, "handed_over": handed_over, "ground_contact": ground_contact}
    return Check(
        truth="closed form",
        step=STEP,
        inputs={"altitude": altitude, "speed": speed},
        outputs={name: follow(value) for name, value in outputs.items()},
        tolerances=dict.fromkeys(outputs, (0.0, 0.0)),
        parameters={"handover_speed": 5.0, "handover_altitude_low": 400.0, "handover_altitude_high": 650.0},
    )


def touchdown_monitor():
    """Check that the first contact is kept through a bounce; it is within all limits."""
    rows, first = 13, 5
    random = np.random.default_rng(282)
    contact = np.isin(np.arange(rows), [first, first + 1, first + 4, first + 5])
    rate = random.normal(0.0, 0.01, (rows, 3))
    position, site = random.normal(0.0, 2.0, (rows, 3)), np.tile([1.0, -2.0, 0.5], (rows, 1))
    inputs = {
        "ground_contact": contact,
        "vertical_speed": random.uniform(-2.5, -0.5, rows),
        "horizontal_speed": random.uniform(0.0, 0.9, rows),
        "tilt": random.uniform(0.0, 0.08, rows),
        "angular_rate": rate,
        "position": position,
        "site": site,
    }
    values = {
        "contact_vertical_speed": -inputs["vertical_speed"][first],
        "contact_horizontal_speed": inputs["horizontal_speed"][first],
        "contact_tilt": inputs["tilt"][first],
        "contact_rate": np.linalg.norm(rate[first]),
        "contact_distance": np.linalg.norm(position[first] - site[first]),
    }
    assert values["contact_rate"] < 0.03
    assert values["contact_distance"] < 10.0
    noted = np.arange(rows) > first  # a row later, and at that row's time
    return Check(
        truth="closed form",
        step=STEP,
        inputs=inputs,
        outputs={
            "contact": noted,
            "contact_time": np.where(noted, STEP * (first + 1), -1.0),
            **{name: np.where(noted, value, 0.0) for name, value in values.items()},
            "within_limits": noted,
        },
        tolerances=dict.fromkeys(("contact", "contact_time", "within_limits"), (0.0, 0.0))
        | dict.fromkeys(values, (1e-14, 1e-14)),
        parameters={"rate_limit": 0.03},
    )


def site_divert():
    """Move the site at the first row from divert_time on: the new target is as high above the sphere as the first."""
    rows, time, radius = 13, 0.6, 1.7e6
    offset, target = np.array([1500.0, -700.0]), np.array([400.0, 300.0, 150.0])
    centre = np.array([0.0, 0.0, -radius])
    altitude = np.linalg.norm(target - centre) - radius
    site = centre + (target - centre) * radius / np.linalg.norm(target - centre)
    radial = site - centre + np.append(offset, 0.0)
    up = radial / np.linalg.norm(radial)
    diverted = STEP * np.arange(rows) >= time
    return Check(
        truth="geometry of the sphere",
        step=STEP,
        inputs={},
        outputs={
            "divert_count": diverted.astype(int),
            "divert_position": np.where(diverted[:, None], centre + (radius + altitude) * up, target),
        },
        tolerances={"divert_count": (0.0, 0.0), "divert_position": (1e-8, 1e-13)},
        parameters={
            "divert_time": time,
            "offset": offset,
            "target_position": target,
            "moon_radius": radius,
        },
    )


TRUTHS = {
    "command_switch": command_switch,
    "flight_monitor": flight_monitor,
    "touchdown_monitor": touchdown_monitor,
    "site_divert": site_divert,
}
