"""Cross-checks with Basilisk, as far as testable without it: comparison of tables, Perilune's sides, the page.

Truth: scipy's Rotation; energy and angular momentum, conserved in a coast and in a free rotation; the declared cases.
"""

import ast
from importlib import import_module

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from crosscheck.__main__ import CASES, HEADS, QUANTITIES, row_of
from crosscheck.case import ATTITUDE, MASS, POSITION, RATE, WHEEL_SPEED, Case
from crosscheck.table import angles_between, at_common_times, differences, read_table, write_table
from docs.reference.formats.pages import format_pages
from perilune.common.paths import ROOT

FOLDER = ROOT / "crosscheck"
PAGE = format_pages()["crosscheck.md"]


def case_of(name):
    return import_module(f"crosscheck.cases.{name}.case").CASE


def side_of(name, step):
    return import_module(f"crosscheck.cases.{name}.ours").simulate(step)


@given(st.integers(0, 2**32 - 1))
def test_angles_between_attitudes(seed):
    """Quaternions of any sign and length."""
    random = np.random.default_rng(seed)
    first, second = (Rotation.random(5, rng=random) for _ in range(2))
    scales = random.choice([-3.0, -1.0, 1.0, 0.5], (2, 5))
    a, b = (scale * each.as_quat(scalar_first=True).T for scale, each in zip(scales, (first, second), strict=True))
    expected = (first.inv() * second).magnitude()
    np.testing.assert_allclose(angles_between(a, b), np.minimum(expected, 2.0 * np.pi - expected), atol=1e-7)
    np.testing.assert_allclose(angles_between(a, -2.0 * a), 0.0, atol=1e-12)


def test_small_angles_keep_their_digits():
    turn = Rotation.from_rotvec([1e-12, 0.0, 0.0]).as_quat(scalar_first=True)[:, None]
    assert angles_between(np.array([[1.0], [0.0], [0.0], [0.0]]), turn)[0] == pytest.approx(1e-12, rel=1e-9)


def test_tables_come_back_exactly(tmp_path):
    table = {"time": np.array([0.0, 0.1]), "mass": np.array([1.0 / 3.0, 1e-300])}
    write_table(tmp_path / "t.csv", table)
    reread = read_table(tmp_path / "t.csv")
    assert {name: column.tolist() for name, column in reread.items()} == {k: v.tolist() for k, v in table.items()}


def test_only_common_times_are_compared():
    ours = {"time": np.array([0.0, 0.1, 0.2, 0.3]), "mass": np.array([1.0, 2.0, 3.0, 4.0])}
    other = {"time": np.array([0.1 + 1e-12, 0.25, 0.3]), "mass": np.array([2.5, 9.0, 4.0])}
    case = Case("", "", "", "", "", "", 0.1, 0.3, {"mass": MASS}, {})
    apart = differences(case, ours, other)
    assert apart["time"].tolist() == [0.1, 0.3]
    assert apart["mass"].tolist() == [0.5, 0.0]
    with pytest.raises(ValueError, match="no common times"):
        at_common_times(ours, {"time": np.array([5.0]), "mass": np.array([1.0])})


def test_vectors_differ_by_their_length():
    time = np.zeros(1)
    ours = {"time": time, **{name: np.array([0.0]) for name in POSITION[1]}}
    other = {"time": time, **{name: np.array([each]) for name, each in zip(POSITION[1], (3.0, 0.0, 4.0), strict=True)}}
    case = Case("", "", "", "", "", "", 0.1, 0.3, {"position": POSITION}, {})
    assert differences(case, ours, other)["position"].tolist() == [5.0]


def test_a_coast_keeps_energy_and_momentum(fmus):
    values = import_module("crosscheck.cases.moon_coast.case")
    table = side_of("moon_coast", 1.0)
    position = np.stack([table[name] for name in POSITION[1]]) + np.array([[0.0], [0.0], [values.RADIUS]])
    velocity = np.stack([table[f"velocity[{k}]"] for k in (1, 2, 3)])
    energy = 0.5 * np.sum(velocity**2, axis=0) - values.MU / np.linalg.norm(position, axis=0)
    momentum = np.linalg.norm(np.cross(position, velocity, axis=0), axis=0)
    np.testing.assert_allclose(energy, -values.MU / (values.APOAPSIS + values.PERIAPSIS), rtol=1e-12)
    np.testing.assert_allclose(momentum, values.APOAPSIS * values.SPEED, rtol=1e-12)


def test_a_free_rotation_keeps_energy_and_momentum(fmus):
    values = import_module("crosscheck.cases.free_rotation.case")
    table = side_of("free_rotation", values.CASE.step)
    rate = np.stack([table[f"rate[{k}]"] for k in (1, 2, 3)])
    momentum = np.array(values.INERTIA)[:, None] * rate
    np.testing.assert_allclose(np.sum(rate * momentum, axis=0), np.sum(rate * momentum, axis=0)[0], rtol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(momentum, axis=0), np.linalg.norm(momentum[:, 0]), rtol=1e-12)
    assert np.min(table["rate[1]"]) < -0.04  # it has tumbled


@pytest.mark.parametrize("name", CASES)
def test_each_case_states_itself_and_has_both_sides(name):
    case = case_of(name)
    assert set(case.bounds) == set(case.quantities) <= set(QUANTITIES)
    assert case.duration / case.step == pytest.approx(round(case.duration / case.step), rel=1e-12)
    for file in ("ours.py", "basilisk.py"):
        assert (FOLDER / "cases" / name / file).is_file()


def test_the_page_has_every_case():
    for name in CASES:
        assert f"| {case_of(name).title} | {case_of(name).verifies} |" in PAGE
    table = PAGE.partition("## Differences")[2].partition("\n## ")[0]
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines() if line.startswith("|")
    ]
    assert tuple(rows[0]) == HEADS
    for name, row in zip(CASES, rows[2:], strict=True):
        case = case_of(name)
        assert row[0] == case.title
        assert float(row[1]) == case.step
        for quantity, cell in zip(QUANTITIES, row[2:-1], strict=True):
            assert (cell != "") == (quantity in case.quantities)
            assert not cell or float(cell) <= case.bounds[quantity]


def test_the_side_of_basilisk_imports_nothing_of_ours():
    for path in FOLDER.rglob("basilisk*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [node.module] if isinstance(node, ast.ImportFrom) else []
            names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            assert not [name for name in names if name.startswith("perilune")], path


@pytest.mark.parametrize(("fine", "said"), [(0.5, "1.0"), (0.25, "2.0"), (1.0 / 16.0, "4.0"), (1.3, "rounding")])
def test_the_order_of_a_difference(fine, said):
    """2^-p with half the step is of order p, also of the first; one that does not fall is rounding."""
    case = Case("title", "", "", "", "", "", 0.1, 0.3, {"mass": MASS}, {})
    assert row_of(case, {"mass": 1.0}, {"mass": fine})[-1] == said


def test_wheels_keep_the_momentum_that_the_torque_does_not_change(fmus):
    """The torque is constant in body axes: in inertial ones momentum grows by its integral, here by trapezoids.

    With step h these are wrong by h^2/12 times the change of the torque's rate, below 1e-4 of what it adds up to.
    """
    values = import_module("crosscheck.cases.wheel_satellite.case")
    table = side_of("wheel_satellite", values.CASE.step)
    rate, speeds = (np.stack([table[name] for name in names]) for names in (RATE[1], WHEEL_SPEED[1]))
    axes = np.array(values.AXES).T / np.linalg.norm(values.AXES, axis=1)
    body = np.array(values.INERTIA) @ rate + values.SPIN_INERTIA * axes @ speeds
    attitude = Rotation.from_quat(np.stack([table[name] for name in ATTITUDE[1]], axis=1), scalar_first=True)
    momentum, torque = attitude.apply(body.T), attitude.apply(values.TORQUE)
    gained = np.cumsum(0.5 * values.CASE.step * (torque[1:] + torque[:-1]), axis=0)
    np.testing.assert_allclose(momentum[1:] - momentum[0], gained, atol=1e-4 * np.abs(gained).max())
    assert np.abs(gained).max() > 0.1
    assert np.abs(speeds).min() > 10.0  # far from rest
