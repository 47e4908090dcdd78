"""Comparisons of models with Basilisk's, as far as testable without it: Perilune's sides, comparison, the page.

Truth: the eclipse in 40 digits; the documented measurement of each sensor, by numpy and scipy's Rotation; the declared
comparisons.
"""

from importlib import import_module

import mpmath
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from crosscheck.__main__ import MODELS
from crosscheck.comparison import HEADS, Comparison, comparison_row, relative_differences
from crosscheck.space.points import attitudes, directions, points
from crosscheck.table import rows_table
from docs.reference.formats.pages import format_pages
from perilune.common.paths import ROOT

FOLDER = ROOT / "crosscheck" / "models"
PAGE = format_pages()["crosscheck.md"]


def case_of(name):
    return import_module(f"crosscheck.models.{name}.case")


def ours(name):
    return import_module(f"crosscheck.models.{name}.ours").evaluate()


def rows(table, name, size=3):
    return np.stack([table[f"{name}[{k + 1}]"] for k in range(size)], axis=1)


@pytest.mark.parametrize("name", MODELS)
def test_each_comparison_states_itself_and_has_both_sides(name):
    case = case_of(name).CASE
    assert set(case.bounds) == set(case.quantities)
    for file in ("ours.py", "basilisk.py"):
        assert (FOLDER / name / file).is_file()


def test_the_page_has_every_comparison():
    table = PAGE.partition("## Models at the same inputs")[2].partition("\n## ")[0]
    lines = [line for line in table.splitlines() if line.startswith("|")]
    entries = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    assert tuple(entries[0]) == HEADS
    for name, row in zip(MODELS, entries[2:], strict=True):
        case = case_of(name).CASE
        assert row[:3] == [case.title, case.basilisk, case.inputs]
        numbers = [float(cell.rpartition(" ")[2]) for cell in row[3].split(",")]
        for number, bound in zip(numbers, case.bounds.values(), strict=True):
            assert number <= bound


def sun_disk(position, sun):
    """Return the visible share in 40 digits, from the areas of two circles on a sphere so far away that it is flat."""
    case = case_of("eclipse")
    r, s = (mpmath.matrix([mpmath.mpf(float(c)) for c in each]) for each in (position, sun))
    away = s - r
    length = lambda v: mpmath.sqrt(sum(c * c for c in v))  # noqa: E731
    a, b = mpmath.asin(case.SUN_RADIUS / length(away)), mpmath.asin(mpmath.mpf(case.EARTH_RADIUS) / length(r))
    c = mpmath.acos(-sum(x * y for x, y in zip(r, away, strict=True)) / (length(r) * length(away)))
    if c >= a + b:
        return 1.0
    if c <= b - a:
        return 0.0
    if c <= a - b:
        return float(1 - (b / a) ** 2)
    first, second = (c * c + a * a - b * b) / (2 * c * a), (c * c + b * b - a * a) / (2 * c * b)
    triangle = mpmath.sqrt((-c + a + b) * (c + a - b) * (c - a + b) * (c + a + b)) / 2
    covered = a * a * mpmath.acos(first) + b * b * mpmath.acos(second) - triangle
    return float(1 - covered / (mpmath.pi * a * a))


def test_our_eclipse_in_40_digits():
    """So that what both codes differ by, up to 2e-9, is Basilisk's rounding."""
    case = case_of("eclipse")
    with mpmath.workdps(40):
        expected = [sun_disk(r, case.SUN) for r in case.POINTS]
    light = ours("eclipse")["light[1]"]
    np.testing.assert_allclose(light, expected, atol=1e-12)
    assert np.sum((light > 0.0) & (light < 1.0)) > 40


def test_our_magnetometer_measures_the_scaled_field(fmus):
    case = case_of("magnetometer")
    sensed = Rotation.from_euler("ZYX", [case.YAW, case.PITCH, case.ROLL]).inv().apply(case.FIELDS)
    expected = np.clip(case.SCALE * (sensed + case.BIAS), -case.RANGE, case.RANGE)
    np.testing.assert_allclose(rows(ours("magnetometer"), "field"), expected, atol=1e-19)
    assert (np.abs(expected) == case.RANGE).any()


def test_our_gyros_measure_the_scaled_rate(fmus):
    case = case_of("gyros")
    sensed = Rotation.from_euler("ZYX", [case.YAW, case.PITCH, case.ROLL]).inv().apply(case.RATES)
    expected = np.clip(np.array(case.SCALE) * (sensed + case.BIAS), -case.RANGE, case.RANGE)
    np.testing.assert_allclose(rows(ours("gyros"), "rate"), expected, atol=1e-15)
    assert (np.abs(expected) == case.RANGE).any()


def test_our_heads_see_the_cosine_within_their_field(fmus):
    case = case_of("sun_heads")
    sun = Rotation.from_quat(case.ATTITUDES, scalar_first=True).inv().apply(case.SUN_DIRECTION)
    cosines = sun @ np.array(case.NORMALS).T
    expected = np.where(cosines >= np.cos(case.FIELD_OF_VIEW), cosines, 0.0) * case.LIGHT[:, None]
    np.testing.assert_allclose(rows(ours("sun_heads"), "currents", 6), expected, atol=1e-15)
    assert ((cosines > 0.0) & (expected == 0.0)).any()


def test_our_nadir_turns_with_the_orbit(fmus):
    """z down, y against the normal; the rate about y is that of the true anomaly, h/r^2."""
    case = case_of("nadir")
    table = ours("nadir")
    axes, rate = rows(table, "axes", 9).reshape(-1, 3, 3), rows(table, "rate")
    r, v = case.POSITIONS, case.VELOCITIES
    distance, momentum = np.linalg.norm(r, axis=1), np.cross(r, v)
    np.testing.assert_allclose(axes[:, 2], -r / distance[:, None], atol=1e-15)
    np.testing.assert_allclose(axes[:, 1], -momentum / np.linalg.norm(momentum, axis=1)[:, None], atol=1e-15)
    np.testing.assert_allclose(rate[:, 1], -np.linalg.norm(momentum, axis=1) / distance**2, rtol=1e-14)
    assert np.abs(rate[:, ::2]).max() < 1e-17


def test_each_plate_is_exposed_at_some_attitudes_and_hidden_at_others():
    """To air and to light."""
    case = case_of("surfaces")
    turn = Rotation.from_quat(case.ATTITUDES, scalar_first=True).inv()
    normals = np.array(case.PLATES)[:, 1:4]
    for direction in (case.VELOCITY, case.SUN):
        exposed = turn.apply(direction) @ normals.T > 0.0
        assert exposed.any(axis=0).all()
        assert (~exposed).any(axis=0).all()
    assert np.abs(rows(ours("surfaces"), "drag")).max() > 1e-5


def test_points_cover_a_sphere():
    around = directions(50)
    np.testing.assert_allclose(np.linalg.norm(around, axis=1), 1.0, atol=1e-15)
    assert np.abs(around[2:].mean(axis=0)).max() < 0.02
    np.testing.assert_allclose(np.linalg.norm(points(5, 1.0, 3.0), axis=1), [1.0, 1.5, 2.0, 2.5, 3.0])
    np.testing.assert_allclose(np.linalg.norm(attitudes(9), axis=1), 1.0, atol=1e-15)


def test_differences_are_relative_to_the_largest():
    case = Comparison("title", "`Module`", "two", {"field": ("field[1]", "field[2]")}, {"field": 1.0})
    other = rows_table(field=np.array([[3.0, 4.0], [0.0, 1.0]]))
    mine = rows_table(field=np.array([[3.0, 4.0], [0.5, 1.0]]))
    assert relative_differences(case, mine, other) == {"field": 0.1}
    assert comparison_row(case, {"field": 0.1})[-1] == "1.0e-01"
    assert comparison_row(case, {"field": 0.1, "torque": 0.0})[-1] == "field 1.0e-01, torque 0"
    with pytest.raises(ValueError, match="1 of 2 inputs"):
        relative_differences(case, rows_table(field=np.array([[3.0, 4.0]])), other)
    with pytest.raises(ValueError, match="field is 0 at all inputs"):
        relative_differences(case, mine, rows_table(field=np.zeros((2, 2))))
