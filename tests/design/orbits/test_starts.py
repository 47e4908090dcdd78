"""Epochs and orbital elements.

Truth: dates published in standards, Python's calendar; a published example, invariants of a conic section.
"""

import re
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import perilune
from perilune.common.paths import ROOT
from perilune.fmus_src.plants.spacecraft import Spacecraft

EARTH = 3.986004415e14  # m3/s2
ELLIPSE = {"semi_major_axis": 7e6, "eccentricity": 0.1}
angles = st.floats(-10.0, 10.0)
instants = st.datetimes(datetime(2017, 1, 1), datetime(2100, 1, 1))


def test_an_equinox():
    assert perilune.epoch("2026-03-20T18:00:00Z") == 827301600.0 + 37.0 + 32.184
    assert perilune.epoch("2026-03-20T21:00:00+03:00") == perilune.epoch("2026-03-20T18:00:00Z")


def test_j2000_in_utc():
    """2000-01-01 12:00 TT was 11:58:55.816 UTC, with 32 leap seconds."""
    assert perilune.epoch("2000-01-01T11:58:55.816Z", leap_seconds=32) == 0.0


@given(instants, st.integers(37, 40))
def test_calendar(time, leap_seconds):
    seconds = perilune.epoch(time.isoformat() + "Z", leap_seconds=leap_seconds)
    elapsed = timedelta(microseconds=round((seconds - leap_seconds - 32.184) * 1e6))
    assert abs(datetime(2000, 1, 1, 12, tzinfo=UTC) + elapsed - time.replace(tzinfo=UTC)) <= timedelta(microseconds=1)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("tomorrow",), "utc: 'tomorrow': not a date and time of ISO 8601; write the time as 2026-03-20T18:00:00Z"),
        ((20260320,), "utc: 20260320: not a date and time of ISO 8601; write the time as 2026-03-20T18:00:00Z"),
        (
            ("2026-03-20T18:00:00",),
            "utc: '2026-03-20T18:00:00': without a time zone; write the time as 2026-03-20T18:00:00Z",
        ),
        (("2016-12-31T23:59:59Z",), "utc: '2016-12-31T23:59:59Z': before 2017; give leap_seconds, TAI - UTC in s at"),
        (("2026-03-20T18:00:00Z", 36.5), "leap_seconds: 36.5: not a whole number; give a whole number, such as 37"),
    ],
)
def test_no_date(arguments, message):
    with pytest.raises(perilune.InputError) as caught:
        perilune.epoch(arguments[0], **dict(zip(["leap_seconds"], arguments[1:], strict=False)))
    assert str(caught.value).startswith(message)


def test_a_published_example():
    """Vallado 2013, example 2-6, with the numbers of its errata; km."""
    angles = np.radians([87.87, 227.89, 53.38, 92.335])
    names = ("inclination", "node", "argument_of_perigee", "true_anomaly")
    r, v = perilune.orbit(
        semi_major_axis=11067790.0 / (1.0 - 0.83285**2),
        eccentricity=0.83285,
        mu=3.986004418e14,
        **dict(zip(names, angles, strict=True)),
    )
    np.testing.assert_allclose(r / 1e3, [6525.368, 6861.532, 6449.119], atol=5e-4)
    np.testing.assert_allclose(v / 1e3, [4.902279, 5.533140, -1.975710], atol=5e-7)


@given(st.floats(6.6e6, 5e7), st.floats(0.0, 0.95), angles, angles, angles, angles)
def test_conic_section(a, e, inclination, node, perigee, anomaly):
    """Vis-viva, the angular momentum's size and direction, the eccentricity vector towards the perigee."""
    r, v = perilune.orbit(
        semi_major_axis=a,
        eccentricity=e,
        inclination=inclination,
        node=node,
        argument_of_perigee=perigee,
        true_anomaly=anomaly,
    )
    distance, momentum = np.linalg.norm(r), np.cross(r, v)
    assert v @ v == pytest.approx(EARTH * (2.0 / distance - 1.0 / a), rel=1e-12)
    normal = np.array([np.sin(node), -np.cos(node), 0.0]) * np.sin(inclination) + [0.0, 0.0, np.cos(inclination)]
    np.testing.assert_allclose(momentum / np.sqrt(EARTH * a * (1.0 - e * e)), normal, atol=1e-12)
    ascending = np.array([np.cos(node), np.sin(node), 0.0])
    towards = np.cos(perigee) * ascending + np.sin(perigee) * np.cross(normal, ascending)
    np.testing.assert_allclose(np.cross(v, momentum) / EARTH - r / distance, e * towards, atol=1e-12)


def test_hyperbola():
    r, v = perilune.orbit(semi_major_axis=-2e7, eccentricity=1.5, true_anomaly=2.0)
    assert v @ v == pytest.approx(EARTH * (2.0 / np.linalg.norm(r) + 1.0 / 2e7), rel=1e-14)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        (
            {"eccentricity": 1.0},
            "eccentricity: 1.0: neither an ellipse nor a hyperbola; give a value from 0 to below 1 (ellipse) or",
        ),
        ({"eccentricity": -0.1}, "eccentricity: -0.1: neither an ellipse"),
        (
            {"semi_major_axis": -7e6},
            "semi_major_axis: -7000000.0: not positive, as an ellipse requires; change semi_major_axis or",
        ),
        (
            {"eccentricity": 1.2},
            "semi_major_axis: 7000000.0: not negative, as a hyperbola requires; change semi_major_axis or",
        ),
        (
            {"semi_major_axis": -7e6, "eccentricity": 1.2, "true_anomaly": 3.0},
            "true_anomaly: 3.0: beyond the asymptote",
        ),
        ({"mu": 0.0}, "mu: 0.0: not positive"),
        ({"node": float("nan")}, "node: nan: not a finite number"),
        ({"inclination": "97.4"}, "inclination: '97.4': not a finite number; give a number in SI units, angles in rad"),
    ],
)
def test_no_orbit(changed, message):
    with pytest.raises(perilune.InputError) as caught:
        perilune.orbit(**ELLIPSE | changed)
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)


def test_the_start_in_the_conventions():
    """The page's own lines make parameters of the plant: its default orbit on the day of its default epoch."""
    page = (ROOT / "docs" / "concepts" / "conventions.md").read_text(encoding="utf-8")
    (lines,) = re.findall(r"^```python\n(.*?perilune\.orbit.*?)^```", page, re.MULTILINE | re.DOTALL)
    names: dict = {"perilune": perilune}
    exec(lines, names)
    start = {name.removeprefix("plant."): number for name, number in names["start"].items()}
    plant = Spacecraft()
    assert start.keys() <= plant.variables.keys()
    assert start["epoch"] - plant.epoch == pytest.approx(69.184, abs=1e-6)
    np.testing.assert_allclose(start["initial_position"], [*plant.initial_position])
    np.testing.assert_allclose(start["initial_velocity"], [*plant.initial_velocity], atol=3.0)
