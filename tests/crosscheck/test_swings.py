"""Cross-checks with flexible modes, and shared code of the spacecraft cases, as far as testable without Basilisk.

Truth: sums of mass, centre and inertia; derivatives of rotations; accelerations from a mass matrix.
"""

from importlib import import_module

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosscheck.__main__ import SWINGS
from crosscheck.space.hub import hub_of, steiner
from crosscheck.space.surroundings import surroundings
from crosscheck.swing import HEADS, TENTH, Swing, swing_differences, swing_row
from docs.reference.formats.pages import format_pages
from perilune.common.paths import ROOT

FOLDER = ROOT / "crosscheck" / "swings"
PAGE = format_pages()["crosscheck.md"]


def case_of(name):
    return import_module(f"crosscheck.swings.{name}.case")


def simulate(name, amplitude):
    return import_module(f"crosscheck.swings.{name}.ours").simulate(amplitude)


@pytest.mark.parametrize("name", SWINGS)
def test_each_swing_has_both_sides(name):
    case = case_of(name).CASE
    assert case.duration / case.step == round(case.duration / case.step)
    for file in ("ours.py", "basilisk.py"):
        assert (FOLDER / name / file).is_file()


def test_the_page_has_every_swing():
    table = PAGE.partition("## Modes")[2].partition("\n## ")[0]
    lines = [line for line in table.splitlines() if line.startswith("|")]
    entries = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert tuple(entries[0]) == HEADS
    for name, row in zip(SWINGS, entries[2:], strict=True):
        case = case_of(name).CASE
        largest, whole, tenth, fall = map(float, row[1:5])
        assert row[0] == case.title
        assert fall == pytest.approx(whole / tenth, rel=0.05)
        assert fall >= case.fall
        assert whole <= case.bound * largest


@given(st.integers(0, 2**32 - 1))
def test_a_hub_and_its_masses_are_the_whole(seed):
    random = np.random.default_rng(seed)
    inertia = np.diag([300.0, 280.0, 260.0]) + 5.0 * np.ones((3, 3))
    masses = [
        (m, s, np.diag([0.3, 0.2, 0.4])) for m, s in zip((10.0, 20.0), random.uniform(-1, 1, (2, 3)), strict=True)
    ]
    hub_mass, centre, about_centre = hub_of(500.0, inertia, masses)
    everything = [(hub_mass, centre, about_centre), *masses]
    assert sum(m for m, _, _ in everything) == pytest.approx(500.0)
    np.testing.assert_allclose(sum(m * s for m, s, _ in everything), 0.0, atol=1e-12)
    np.testing.assert_allclose(sum(i + steiner(m, s) for m, s, i in everything), inertia, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("name", SWINGS)
def test_our_flights_are_linear_in_their_modes(fmus, name):
    """From rest displacements grow with the drive, but for what body axes turn meanwhile."""
    whole, tenth = (simulate(name, size)["displacement[1]"] for size in (TENTH, 0.1 * TENTH))
    np.testing.assert_allclose(whole, 10.0 * tenth, atol=0.05 * np.abs(whole).max())
    assert np.abs(whole).max() > 1e-5


def slosh_masses(case):
    """Return mass, centre, inertia, velocity of the centre and axis of rotation of each moving mass by its
    coordinate."""
    still = np.zeros(3)
    lines = zip(case.PARTICLES, case.POSITIONS, case.ALONG, strict=True)
    return [(mass, position, np.zeros((3, 3)), along, still) for mass, position, along in lines]


def panel_masses(case):
    """Return the same of hinged panels."""
    centres = zip(case.CENTRES, case.OUTWARDS, strict=True)
    return [
        (case.PANEL, centre, case.PANEL_INERTIA, np.cross(case.AXIS, case.ARM * outwards), case.AXIS)
        for centre, outwards in centres
    ]


def cross_matrix(v):
    return np.cross(v, np.eye(3)).T


@pytest.mark.parametrize(("name", "masses_of"), [("slosh", slosh_masses), ("panels", panel_masses)])
def test_our_flights_begin_as_the_bodies_do(fmus, name, masses_of):
    """First angular acceleration by the mass matrix of hub and masses, sum of m Jv'Jv + Jw'I Jw; springs are at rest.

    Over a first step of 1/64 s the springs change it by about their frequency times the step, squared: 1e-3.
    """
    case = case_of(name)
    masses = masses_of(case)
    hub = hub_of(case.MASS, case.INERTIA, [each[:3] for each in masses])
    still = np.zeros(3)
    matrix = np.zeros((6 + len(masses), 6 + len(masses)))
    for k, (mass, centre, inertia, velocity, axis) in enumerate([*masses, (*hub, still, still)]):
        along, about = (np.zeros((3, 6 + len(masses))) for _ in range(2))
        along[:, :6], about[:, 3:6] = np.hstack([np.eye(3), -cross_matrix(centre)]), np.eye(3)
        if k < len(masses):
            along[:, 6 + k], about[:, 6 + k] = velocity, axis
        matrix += mass * along.T @ along + about.T @ inertia @ about
    drive = np.concatenate([case.FORCE, case.TORQUE, np.zeros(len(masses))])
    expected = np.linalg.solve(matrix, drive)
    table = simulate(name, 1.0)
    step = case.CASE.step
    rate = np.array([table[f"rate[{k}]"][1] for k in (1, 2, 3)])
    displacement = np.array([table[f"displacement[{k + 1}]"][1] for k in range(len(masses))])
    np.testing.assert_allclose(rate / step, expected[3:6], atol=1e-3 * np.linalg.norm(expected[3:6]))
    np.testing.assert_allclose(2.0 * displacement / step**2, expected[6:], atol=1e-3 * np.abs(expected[6:]).max())


def test_axes_of_the_earth_turn_as_their_rate_says():
    """Central differences over half a second before and after: w^3/24 off."""
    before, now, after = (surroundings(1.0, 2.0, at=at) for at in (-0.5, 0.0, 0.5))
    slope = np.subtract(after["axes"], before["axes"])
    np.testing.assert_allclose(slope, now["axes_rate"], atol=1e-13)
    np.testing.assert_allclose(np.array(now["axes"][0]) @ np.transpose(now["axes"][0]), np.eye(3), atol=1e-14)
    assert not np.any(surroundings(1.0, 1.0, turns=False)["axes_rate"])


def test_a_fall_is_how_often_the_difference_is_that_of_a_tenth():
    time = np.array([0.0, 1.0])
    columns = ("rate[1]", "rate[2]", "rate[3]", "displacement[1]")
    still = {"time": time, **dict.fromkeys(columns, np.zeros(2))}
    other = still | {"rate[1]": np.array([0.0, 0.5]), "displacement[1]": np.array([0.0, 2.0])}
    mine = other | {"rate[2]": np.array([0.0, 0.1]), "displacement[1]": np.array([0.0, 1.5])}
    case = Swing("title", "", "", 1.0, 1.0, ("displacement[1]",), 80.0, 1.0)
    assert swing_differences(case, mine, other) == (0.5, pytest.approx(0.1), 0.25)
    assert swing_row(case, (0.5, 0.1, 0.25), (0.05, 0.001, 0.02))[1:] == [
        *("5.0e-01", "1.0e-01", "1.0e-03", "100", "2.5e-01", "2.0e-02")
    ]
