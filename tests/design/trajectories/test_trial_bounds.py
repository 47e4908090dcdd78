"""`perilune design bounds`: the table of each trial's bound, and the metric that compares flights with it.

Truth: Clarabel in another formulation, at the stored duration; SHA-256 by hashlib; propellant over the bound.
"""

import csv
import hashlib
import json
import re

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.draws.table import draw_table
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS
from tests.support.flights.convex_descent import A1, C1, settle
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
CAMPAIGNS = SYSTEMS / "lunar_landing" / "campaigns"
BASES = {"laws_terminal": C1, "laws_braking": C1, "laws_approach": A1}
FIRST_60 = {
    "laws_terminal": 261.659,
    "laws_braking": 400.471,
}  # kg, means by the interior point of the blocks' prototype


def rows_of(path):
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))


def starts(campaign):
    """Return position and velocity of the trials of a shipped campaign."""
    columns = draw_table(read_plan("lunar_landing", campaign, SystemOptions()).campaign).columns
    flat = np.zeros_like(columns["plant.initial_position[1]"])  # what is not drawn is 0: out of plane
    return [
        np.stack([columns.get(f"plant.initial_{name}[{axis}]", flat) for axis in (1, 2, 3)], axis=1)
        for name in ("position", "velocity")
    ]


@pytest.mark.parametrize("campaign", BASES)
def test_shipped_tables_have_every_trial(campaign):
    """Hashes of the starts by hashlib, and bounds at their durations by Clarabel in another formulation."""
    rows = rows_of(CAMPAIGNS / "bounds" / f"{campaign}.csv")
    assert len(rows) == 300
    base, (positions, velocities) = BASES[campaign], starts(campaign)
    numbers = {
        "mass": [base.mass],
        "specific_impulse": [319.0],
        "maximum_thrust": [base.maximum],
        "minimum_thrust": [base.minimum],
        "moon_radius": [1737400.0],
        "gravitational_parameter": [4.9028e12],
        "target": base.target.tolist(),
    }
    if campaign == "laws_approach":
        numbers |= {"glide_slope": [np.pi / 12], "glide_offset": [5.0], "largest_tilt": [np.pi / 3]}
    for row, position, velocity in zip(rows, positions, velocities, strict=True):
        inputs = numbers | {"position": position.tolist(), "velocity": velocity.tolist()}
        text = "\n".join(f"{name} {' '.join(map(float.hex, inputs[name]))}" for name in sorted(inputs))
        assert row["inputs"] == hashlib.sha256(text.encode()).hexdigest()[:16]
    for trial in range(0, 300, either(15, 150)):
        descent = type(base)(**(vars(base) | {"position": positions[trial], "velocity": velocities[trial]}))
        path = settle(descent, float(rows[trial]["duration"]) + 0.05, 6)
        coarse = -base.mass * np.expm1(path.log_mass[-1])  # of 24 intervals, which cost up to some tenths of a per cent
        assert coarse * 0.995 < float(rows[trial]["propellant"]) < coarse * 1.0005


@pytest.mark.parametrize("campaign", FIRST_60)
def test_means_are_those_of_the_prototype(campaign):
    rows = rows_of(CAMPAIGNS / "bounds" / f"{campaign}.csv")
    assert np.mean([float(row["propellant"]) for row in rows[:60]]) == pytest.approx(FIRST_60[campaign], abs=0.02)


@pytest.fixture
def mine(tmp_path):
    """Write a short campaign whose table is missing."""
    path = tmp_path / "mine.toml"
    path.write_text('extends = "laws_approach"\ntrials = 2\nseed = 5\n[lookup.bound]\nfile = "tables/mine.csv"\n')
    return path


def test_stored_and_looked_up(mine, capsys):
    call = ["design", "bounds", "lunar_landing", "--campaign", str(mine), "--intervals", "12", "--workers", "1"]
    with pytest.raises(
        InputError, match=r"no file tables/mine.csv; compute the table again; perilune design bounds computes"
    ):
        perilune.batch("lunar_landing", mine, workers=1)
    assert main([*call, "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert not (mine.parent / "tables").exists()
    assert main([*call, "--store"]) == 0
    out = capsys.readouterr().out
    path = mine.parent / "tables" / "mine.csv"
    assert re.search(r"2 trials \(12 intervals\)\n  bound [\d.]+ kg on average, [\d.]+ to [\d.]+ kg\nstored: ", out)
    stored = [float(row["propellant"]) for row in rows_of(path)]
    assert stored == pytest.approx(document["propellant_kg"], abs=1e-6)
    assert (
        perilune.bound_trials("lunar_landing", mine, intervals=12, workers=2).propellant.tolist()
        == (document["propellant_kg"])
    )
    flown = perilune.batch("lunar_landing", mine, configuration="convex_guidance", workers=1).trials["convex_guidance"]
    assert flown.metrics["excess"] == pytest.approx(100.0 * (flown.metrics["propellant"] / stored - 1.0))
    assert np.all(flown.metrics["excess"] > 0.0)
    mine.write_text(mine.read_text() + '[set]\n"plant.initial_mass" = 570\n')
    with pytest.raises(InputError, match="trial 0: computed for inputs") as error:
        perilune.batch("lunar_landing", mine, workers=1)
    remedy = f"write it again: perilune design bounds lunar_landing --campaign {mine} --intervals 12 --store"
    assert str(error.value).endswith(remedy)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[lookup.bound.inputs]\nmass = 0', r"lookup.bound.inputs.mass: 0 is not positive"),
        ('[lookup.bound.inputs]\nweight = 3', r"lookup.bound.inputs.weight: not an input of a bound"),
        ('[lookup.bound.inputs]\ntarget = "altitude"', r"lookup.bound.inputs.target: 1 numbers, not 3"),
        ('[lookup.bound.inputs]\nmass = "guidance.frozen_time_to_go"', r"no.*|neither a signal nor a parameter"),
    ],
)  # fmt: skip
def test_wrong_inputs(mine, text, words):
    mine.write_text(f"{mine.read_text()}{text}\n")
    with pytest.raises(InputError, match=words):
        perilune.bound_trials("lunar_landing", mine, workers=1)


def test_campaigns_without_bounds(tmp_path):
    with pytest.raises(InputError, match=r"terminal_box.toml: lookup.bound: the campaign does not declare"):
        perilune.bound_trials("lunar_landing", "terminal_box", workers=1)


def test_a_target_out_of_reach_is_a_problem(mine, capsys):
    mine.write_text(mine.read_text() + "[lookup.bound.inputs]\nmaximum_thrust = 600\n")
    call = ["design", "bounds", "lunar_landing", "--campaign", str(mine), "--intervals", "10", "--workers", "1"]
    assert main([*call, "--trials", "1"]) == 1
    captured = capsys.readouterr()
    assert "1 trials (the first is 0) cannot reach the target within any duration" in captured.err + captured.out
