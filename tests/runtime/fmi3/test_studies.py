"""Campaigns, studies and margins with FMUs of FMI 3.0. Truth: closed form of the strict FMU, y' = gain u."""

import math

import numpy as np
import pytest
from scipy import stats

import perilune
from perilune.analysis.stability.loops.readings import decibel_size, degree_size
from tests.support.builders import component, connection, document, pack, system
from tests.support.fmi3.reference import reference_fmu
from tests.support.fmi3.strict_fmu import strict_fmu
from tests.support.loops.foreign_fmus import build_foreign_fmus

# After 1 s y[1] = u[1] and y[2] = 2 u[2], so total is normal with mean 0 and standard deviation 1.
CAMPAIGN = """
system = "strict"
trials = 40
seed = 5
[draw."Strict.u[1]"]
distribution = "normal"
mean = 1
sigma = 0.6
[draw."Strict.u[2]"]
distribution = "normal"
mean = -0.5
sigma = 0.4
[metric.total]
expression = "Strict.y[1] + Strict.y[2]"
reduction = "final"
[success]
expression = "total < 2"
"""


@pytest.fixture(scope="module")
def linear(tmp_path_factory):
    folder = tmp_path_factory.mktemp("linear")
    (folder / "c.toml").write_text(CAMPAIGN)
    return str(strict_fmu(folder)), str(folder / "c.toml")


@pytest.mark.parametrize("workers", [1, 2])
def test_batch(linear, workers):
    trials = perilune.batch(*linear, workers=workers).trials["default"]
    expected = trials.draws["Strict.u[1]"] + 2.0 * trials.draws["Strict.u[2]"]
    assert np.array_equal(trials.metrics["total"], expected)


def test_rare_failure(linear):
    study = perilune.rare(*linear, failure="total > 3.090232306", samples=500, workers=1)
    low, high = study.interval
    assert stats.norm.sf(3.090232306) == pytest.approx(1e-3, rel=1e-6)
    assert low < 1e-3 < high < 5e-3


def test_worst_case(linear):
    """In the box of 3 sigmas: 1.8 + 2 times 1.2."""
    assert perilune.worst(*linear, metric="total", flights=100, workers=1).value == pytest.approx(4.2, rel=1e-6)


def test_sensitivity(linear):
    total = perilune.sensitivity(*linear, 128, workers=1).of("total")
    assert total["Strict.u[1]"]["first"] == pytest.approx(0.36, abs=0.1)
    assert total["Strict.u[2]"]["first"] == pytest.approx(0.64, abs=0.1)


def test_margins_of_a_loop_of_both_versions(tmp_path):
    """An integrator of FMI 3.0 and a delayed gain of FMI 2.0: |L| = g / (2 sin(a / 2)) with phase -pi/2 - 3 a / 2."""
    step, gain = 0.1, 4.0
    build_foreign_fmus(tmp_path)
    strict_fmu(tmp_path)
    root = system(
        component("law", "law", "input u Real; output y Real"),
        component("plant", "strict", "input u[1] Real; output y[1] Real"),
        connections=connection("law.y", "plant.u[1]") + connection("plant.y[1]", "law.u"),
    )
    path = pack(tmp_path / "loop.ssp", tmp_path, document(root, stop=10.0, step=step))
    values = {"plant.n": 1, "plant.gain": 1.0}
    study = perilune.stability(path, loops=["law.y"], at=1.0, feedthrough=["law"], set=values)
    (loop,) = study.loops
    size = gain * step
    assert decibel_size(loop.classical.gain_margin.value) == pytest.approx(-20.0 * math.log10(size), abs=0.01)
    expected = math.degrees(0.5 * math.pi - 3.0 * math.asin(0.5 * size))
    assert degree_size(loop.classical.phase_margin.value) == pytest.approx(expected, abs=0.05)
    assert "does not document how it serialises its state" in loop.not_applicable["linearisation"]


def test_bounces_of_a_ball_lose_their_share_of_speed():
    """BouncingBall: after a bounce at speed v it leaves at e v, so that a drawn e appears in the later motion."""
    path = str(reference_fmu(3, "BouncingBall"))
    for restitution in (0.6, 0.8):
        flight = perilune.simulate(path, set={"BouncingBall.e": restitution}, step=0.001, stop_time=1.0)
        speed = flight.signals["BouncingBall.v"]
        first = int(np.flatnonzero(speed > 0.0)[0])
        assert speed[first] / -speed[first - 1] == pytest.approx(restitution, rel=0.01)


def test_described_and_validated(tmp_path):
    path = strict_fmu(tmp_path)
    assert perilune.validate(str(path)).problems() == []
    rows = {row["name"]: row for row in perilune.describe(str(path), set={"Strict.n": 3})["variables"]}
    assert (rows["u"]["size"], rows["u"]["unit"], rows["u"]["minimum"]) == (3, "m", -100.0)
    assert (rows["n"]["causality"], rows["n"]["value"]) == ("structuralParameter", 3)
    assert rows["single_in"]["value"] == [0.0, -1.0]
    assert rows["factor"]["value"] == [1.0, 2.0, None]
