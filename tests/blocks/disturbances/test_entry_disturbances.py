"""Gusts, changes of density and jet health. Truth: their definitions, evaluated here."""

import math

import pytest

from perilune.fmus_src.disturbances.air_disturbance import AirDisturbance
from perilune.fmus_src.disturbances.jet_health import JetHealth


def at(block, time):
    block.step(time - 0.2, 0.2)
    return block


def test_a_gust_comes_and_goes():
    block = AirDisturbance(wind=[1.0, 0.0, 0.0], gust=[0.0, 0.0, 100.0], gust_time=370.0, gust_duration=10.0)
    block.initialize()
    for time, fraction in [
        (0.0, 0.0),
        (370.0, 0.0),
        (372.5, 0.5),
        (375.0, 1.0),
        (377.5, 0.5),
        (380.0, 0.0),
        (400.0, 0.0),
    ]:
        assert [*at(block, time).air_velocity] == pytest.approx([1.0, 0.0, 100.0 * fraction], abs=1e-9)
    assert at(block, 371.0).air_velocity.z == pytest.approx(50.0 * (1.0 - math.cos(math.pi / 5.0)))


def test_the_density_changes_once():
    block = AirDisturbance(density=1.1, density_time=120.0, later_density=1.5)
    block.initialize()
    assert [at(block, time).density_factor for time in (0.2, 119.8, 120.0, 300.0)] == [1.1, 1.1, 1.5, 1.5]


def test_jets_have_the_factors_that_are_given():
    block = JetHealth(factors=[1.0, 0.5, 1.0, 0.0, 1.0, 1.0])
    block.initialize()
    assert [*at(block, 1.0).jet_factor] == [1.0, 0.5, 1.0, 0.0, 1.0, 1.0]
