"""Perilune's sides of the cross-checks in a low orbit.

Truth: the energy in a zonal potential, by scipy's Legendre polynomials, and in the tidal potential of Sun and Moon; the
momentum added by dipoles in a field from other code; drag and solar pressure in closed form.
"""

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.special import eval_legendre

from crosscheck.case import ATTITUDE, POSITION, RATE, VELOCITY
from crosscheck.cases.leo_plates import case as plates
from crosscheck.cases.leo_plates import ours as plates_side
from crosscheck.cases.leo_torquers import case as torquers
from crosscheck.cases.leo_torquers import ours as torquers_side
from crosscheck.cases.leo_zonal import case as zonal
from crosscheck.cases.leo_zonal import ours as zonal_side
from perilune.fmus_src.mathlib.space.surfaces import SOLAR_PRESSURE
from tests.support.checks.space import harmonics


def columns(table, kind):
    return np.stack([table[name] for name in kind[1]], axis=1)


def momentum(table, inertia):
    """Return angular momentum (N m s, inertial) by row."""
    attitude = Rotation.from_quat(columns(table, ATTITUDE), scalar_first=True)
    return attitude, attitude.apply(columns(table, RATE) @ np.array(inertia))


def tide(position, body, mu):
    """Return potential (J/kg, by row) of a body at positions (m) from a centre that it attracts, too."""
    distance = np.linalg.norm(body, axis=1)
    inverse = 1.0 / np.linalg.norm(body - position, axis=1) - np.sum(body * position, axis=1) / distance**3
    return mu * (inverse - 1.0 / distance)


def test_energy_stays_in_zonal_gravity(fmus):
    """To 0.05 J/kg, while the tides change by 9; degree 8 alone is 7, degrees 3 to 8 are 258 J/kg."""
    table, step = zonal_side.simulate(20.0), 20.0
    surroundings = zonal_side.handed_over(step)
    position, velocity = columns(table, POSITION), columns(table, VELOCITY)
    distance, pole = np.linalg.norm(position, axis=1), np.array(surroundings["axes"][0])[2]
    tides = sum(
        tide(position[:-1], np.array(surroundings[name]), surroundings[f"{name}_mu"]) for name in ("sun", "moon")
    )
    sine, ratio = position @ pole / distance, surroundings["radius"] / distance

    def energy(degree):
        coefficients = [surroundings["normalised"][n * (n + 1) - 6] * np.sqrt(2 * n + 1) for n in range(2, degree + 1)]
        terms = sum(c * ratio**n * eval_legendre(n, sine) for n, c in enumerate(coefficients, 2))
        whole = 0.5 * np.sum(velocity**2, axis=1) - surroundings["earth_mu"] / distance * (1.0 + terms)
        return whole[:-1] - tides

    assert np.ptp(energy(zonal.DEGREE)) < 0.05
    assert np.ptp(energy(zonal.DEGREE - 1)) > 5.0


def test_dipoles_add_their_torque_to_the_angular_momentum(fmus):
    """Within the first 200 s, with the gravity gradient, by trapezoids."""
    step = torquers.CASE.step
    table = torquers_side.simulate(step)
    surroundings = torquers_side.handed_over(step)
    rows = slice(0, 201)
    attitude, whole = momentum(table, torquers.INERTIA)
    dipole = np.clip(torquers.COMMANDS[0][1], -torquers.LIMIT, torquers.LIMIT) + np.array(torquers.RESIDUAL)
    axes = np.array(surroundings["axes"])[rows] - 0.5 * step * np.array(surroundings["axes_rate"])[rows]
    fixed = np.einsum("kij,kj->ki", axes, columns(table, POSITION)[rows])
    field = np.array([harmonics.magnetic_field(r, torquers_side.magnetic_field.START, 12) for r in fixed])
    torque = np.cross(attitude[rows].apply(dipole), np.einsum("kij,ki->kj", axes, field))
    up = columns(table, POSITION)[rows] / np.linalg.norm(columns(table, POSITION)[rows], axis=1, keepdims=True)
    down = attitude[rows].apply(attitude[rows].inv().apply(up) @ np.array(torquers.INERTIA))
    torque = torque + 3.0 * torquers.MU / np.linalg.norm(torquers.START) ** 3 * np.cross(up, down)
    gained = np.sum(0.5 * step * (torque[1:] + torque[:-1]), axis=0)
    assert np.linalg.norm(whole[200] - whole[0] - gained) < 1e-4 * np.linalg.norm(gained)
    assert np.linalg.norm(gained) > 0.1


def test_plates_are_pushed_by_air_and_light(fmus):
    """After 10 s, force by central differences less gravity; those are of fourth order, 5e-9 of it."""
    step = 0.25
    table = plates_side.simulate(step)
    position, velocity = columns(table, POSITION), columns(table, VELOCITY)
    r, k = position[40], 40
    acceleration = (8.0 * (velocity[k + 1] - velocity[k - 1]) - velocity[k + 2] + velocity[k - 2]) / (12.0 * step)
    felt = plates.MASS * (acceleration + plates.MU / np.linalg.norm(r) ** 3 * r)
    surroundings = plates_side.handed_over(step)
    rate = (
        np.array(surroundings["axes_rate"])[k][0]
        @ np.array(surroundings["axes"])[k][1]
        * np.array(surroundings["axes"])[k][2]
    )
    turn = Rotation.from_quat(columns(table, ATTITUDE)[k], scalar_first=True)
    against, away = velocity[k] - np.cross(rate, r), np.array(surroundings["sun"])[k] - r
    density = plates.DENSITY * np.exp((plates.HEIGHT + plates.RADIUS - np.linalg.norm(r)) / plates.SCALE_HEIGHT)
    distance = np.linalg.norm(away)
    pressure = plates.LARGER * SOLAR_PRESSURE * (149597870700.0 / distance) ** 2
    sun, expected = away / distance, np.zeros(3)
    for area, *numbers, drag, specular, diffuse in plates.PLATES:
        normal = turn.apply(numbers[:3])
        expected -= 0.5 * density * drag * area * max(normal @ against, 0.0) * against
        cosine = max(normal @ sun, 0.0)
        expected -= (
            pressure * area * cosine * ((1.0 - specular) * sun + 2.0 * (diffuse / 3.0 + specular * cosine) * normal)
        )
    np.testing.assert_allclose(felt, expected, atol=1e-7 * np.linalg.norm(expected))
    assert np.linalg.norm(expected) > 1e-4
