"""perilune.analysis.documents.common.quantities: units, numbers and ticks as text. Truth: the texts, written here."""

import math

import pytest

from perilune.analysis.documents.common.quantities import (
    display_unit,
    in_display_unit,
    label_with_unit,
    log_tick,
    number,
    tick,
)


@pytest.mark.parametrize(
    ("unit", "shown"),
    [
        (None, ""), ("1", ""), ("m", "m"), ("m/s2", "m/s²"), ("rad", "deg"), ("rad/s2", "deg/s²"), ("kg.m2", "kg·m²"),
        ("radian", "radian"), ("m-1", "m⁻¹"),
    ],
)  # fmt: skip
def test_units(unit, shown):
    assert display_unit(unit) == shown


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (None, "–"), (True, "true"), (3, "3"), (-3, "−3"), (0.5, "0.5"), (-0.0, "0"), (1e-9, "1e-9"),  # noqa: RUF001
        (-2.5e-7, "−2.5e-7"), (123456.0, "123500"), (1.5e6, "1.5e6"),  # noqa: RUF001
        (-98765.0, "−98760"), (math.inf, "∞"), (math.nan, "not a number"),  # noqa: RUF001
    ],
)  # fmt: skip
def test_numbers(value, shown):
    assert number(value) == shown


def test_angles_are_shown_in_degrees_and_nothing_else_changes():
    assert in_display_unit(math.pi, "rad") == 180.0
    assert in_display_unit(math.pi, "m") == math.pi
    assert in_display_unit(None, "rad") is None
    assert label_with_unit("tilt", "rad/s") == "tilt, deg/s"
    assert label_with_unit("count", None) == "count"


def test_ticks():
    assert [tick(value) for value in (0.30000000000000004, -20.0, 75000.0, 2e9)] == [
        "0.3",
        "\N{MINUS SIGN}20",
        "75000",
        "2e9",
    ]
    assert [log_tick(value) for value in (1e-5, 0.01, 100.0, 1e6)] == ["10⁻⁵", "0.01", "100", "10⁶"]
