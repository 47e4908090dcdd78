"""Numbers in docs/papers/huang.md equal the results of its commands.

Truth: the plans, which other tests verify independently.
"""

import math
from dataclasses import replace

import pytest

from perilune.analysis.design.trajectories.vehicle import HOVER_TRANSFER, HOVER_VEHICLE
from perilune.analysis.design.transfers.free_fall import find_free_fall
from perilune.analysis.design.transfers.hover_study import hover_study
from perilune.analysis.design.transfers.programme import find_programme
from perilune.common.paths import ROOT

PAGE = (ROOT / "docs" / "papers" / "huang.md").read_text(encoding="utf-8")
DISTANCES = (50, 100, 200, 300, 500, 700, 1000, 1600, 2000, 3000)


@pytest.fixture(scope="module")
def study():
    more = {"optimum": True, "adjoint": True, "finite_switches": True, "free_fall": True}
    return hover_study(HOVER_VEHICLE, HOVER_TRANSFER, distances=DISTANCES, **more)


def percent(part, whole):
    return f"{100.0 * (part / whole - 1.0):.1f}"


def test_turn_in_free_fall(study):
    more = [100.0 * (each.free_fall / each.programme - 1.0) for each in study.comparisons]
    assert f"{min(more):.3g} to {max(more):.3g} % more at distances of {DISTANCES[0]} to {DISTANCES[-1]} m" in PAGE
    assert f"--distances {','.join(map(str, DISTANCES))}`" in PAGE
    begun = find_free_fall(study.programme, 0.6)
    fractions = [each.propellant_fraction for each in (study.free_fall, begun)]
    waiting, turning = (percent(each, study.programme.propellant_fraction) for each in fractions)
    assert f"{waiting} % more at 1600 m become {turning} %" in PAGE


def test_optimum_and_its_conditions(study):
    optimum, programme = study.optimum.propellant_fraction, study.programme.propellant_fraction
    straight = study.vertical.propellant_fraction
    assert f"the programme {percent(programme, straight)} %, the optimum {percent(optimum, straight)} %" in PAGE
    assert f"takes {percent(programme, optimum)} % more than the optimum" in PAGE
    assert f"takes {100.0 * (study.finite.propellant_fraction / optimum - 1.0):.2f} % more" in PAGE
    begin, end = study.adjoint.singular_span
    assert f"to {math.degrees(study.adjoint.tangent_residual[1]):.3f} deg from {begin:.1f} to {end:.1f} s" in PAGE


def test_programmes_of_other_values():
    timed = find_programme(HOVER_VEHICLE, HOVER_TRANSFER, 78.0)
    t2, _, _, tp, _ = timed.times
    assert f"{t2:.3f} s, {timed.threshold:.4f}, {tp:.3f} s" in PAGE
    assert f"{timed.propellant_fraction:.6f}; the printed" in PAGE
    best = find_programme(HOVER_VEHICLE, HOVER_TRANSFER)
    assert f"{best.duration:.3f} s, {best.propellant_fraction:.6f}" in PAGE
    other = find_programme(HOVER_VEHICLE, replace(HOVER_TRANSFER, gravity=1.62))
    assert f"has {other.propellant_fraction:.6f} in place of {best.propellant_fraction:.6f}" in PAGE
