"""Truths of the space environment: published series and tables, coded in `checks.space`."""

import numpy as np

from tests.support.checks.check import Check, follow
from tests.support.checks.plants.spacecraft import matrix_of
from tests.support.checks.space import celestial, harmonics, surroundings
from tests.support.checks.vectors import unit

STEP, ROWS = 16.0, 41
TT_MINUS_UT1, BULGE, DEGREE, DENSITY_FACTOR = 70.25, 5.0, 13, 0.4
EPOCH = harmonics.FIELD_END - 28.5 * STEP  # so that the years of the magnetic field end on the way


def positions():
    """Return positions out of the light through half-shadow and shadow, at heights from 150 to 900 km."""
    sun = unit(celestial.sun(EPOCH))
    across = unit(np.cross(np.cross(sun, [0.3, -0.5, 1.0]), sun))
    radius = 6378137.0 + np.linspace(150e3, 900e3, ROWS)
    angle = np.linspace(0.3, 2.9, ROWS)  # from the Sun
    edge = np.pi - np.arcsin(6378137.0 / radius)
    angle[20:29] = edge[20:29] + np.linspace(-0.5e-2, 0.5e-2, 9)
    angle[29:] = np.linspace(2.3, 2.9, ROWS - 29)
    return radius[:, None] * (np.cos(angle)[:, None] * sun + np.sin(angle)[:, None] * across)


def evaluate(t, r, q):
    """Return the outputs at a time (s) for a position (m, inertial) and an attitude."""
    time = EPOCH + t
    sun = celestial.sun(time)
    fixed = celestial.earth_fixed(time, celestial.earth_pole(time), TT_MINUS_UT1)
    field = fixed.T @ harmonics.magnetic_field(fixed @ r, EPOCH, DEGREE)
    height = surroundings.height(fixed @ r)
    assert 0.0 < height < 1000e3
    return {
        "sun_direction": unit(sun - r),
        "sun_distance": np.linalg.norm(sun - r),
        "moon_position": celestial.moon(time),
        "illumination": surroundings.light(r, sun),
        "magnetic_field": field,
        "magnetic_field_body": matrix_of(unit(q)).T @ field,
        "density": DENSITY_FACTOR * surroundings.density(r, sun, BULGE, height),
        "planet_angle": celestial.earth_angle(time, TT_MINUS_UT1),
        "status": 2.0 if height < 100e3 else float(time > harmonics.FIELD_END),
    }


def space_environment():
    """Check light, half-shadow, shadow, less than 100 km; outputs stay at a quaternion of
    length 0 and inside the Earth."""
    r, q = positions(), np.random.default_rng(58).normal(size=(ROWS, 4))
    q[:, 0] += np.where(q[:, 0] > 0.0, 0.5, -0.5)
    q[6] = 0.0
    r[9] *= 6.43e6 / np.linalg.norm(r[9])
    r[12] *= 6.3e6 / np.linalg.norm(r[12])
    inputs, rows = follow(np.arange(ROWS)), []
    for n, k in enumerate(inputs):
        if k in (6, 12):
            rows.append(rows[-1] | {"status": 3.0})
        else:
            rows.append(evaluate(STEP * n, r[k], q[k]))
    outputs = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    assert set(outputs["status"]) == {0.0, 1.0, 2.0, 3.0}
    light = outputs["illumination"]
    assert min((light == 1.0).sum(), (light == 0.0).sum(), ((light > 0.0) & (light < 1.0)).sum()) > 4
    return Check(
        truth="published series and tables; spherical coordinates, segments of disks, the foot on the ellipsoid",
        step=STEP,
        inputs={"position": r, "quaternion": q},
        outputs=outputs,
        tolerances={
            "sun_direction": (1e-13, 0.0),
            "sun_distance": (1e-3, 0.0),
            "moon_position": (1e-3, 0.0),
            "illumination": (1e-11, 0.0),
            "magnetic_field": (1e-18, 0.0),
            "magnetic_field_body": (1e-18, 0.0),
            "density": (0.0, 1e-11),
            "planet_angle": (1e-12, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "epoch": EPOCH,
            "tt_minus_ut1": TT_MINUS_UT1,
            "density_factor": DENSITY_FACTOR,
            "bulge_exponent": BULGE,
            "magnetic_degree": np.array(DEGREE),
        },
    )


TRUTHS = {"space_environment": space_environment}
