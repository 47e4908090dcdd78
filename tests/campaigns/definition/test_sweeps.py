"""perilune.analysis.campaigns.definition.sweeps: parameters from low to high in steps, as a grid dispersion.

Truth: exact fractions for the points; a campaign file that declares the same grid; the rule that anything that cannot
be swept is refused in one line that names --set.
"""

import json
from fractions import Fraction
from math import floor

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import perilune
from perilune.analysis.campaigns.definition.campaign import Campaign
from perilune.analysis.campaigns.definition.distributions import Grid
from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.sweeps import split_sweeps, with_sweeps
from perilune.analysis.campaigns.draws.table import draw_table
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.paths import SYSTEMS

SYSTEM = "lunar_terminal_guidance"
MASS = "plant.initial_mass"
SWEEP = f"{MASS}=900:1000:25"
ONE = {"guidance": ["analytic_guidance"]}


def grid(campaign):
    return {draw.name: draw.distribution.values for draw in campaign.draws if isinstance(draw.distribution, Grid)}


@given(st.integers(-2000, 2000), st.integers(1, 300), st.integers(1, 60), st.integers(0, 299), st.integers(0, 3))
@example(0, 1, 3, 0, 1)  # 0:0.3:0.1, where 0.3 / 0.1 is below 3
@example(0, 1, 10, 0, 1)
def test_points_are_those_of_exact_arithmetic(low, step, count, more, digits):
    scale = 10**digits
    high = low + count * step + more % step
    texts = [f"{float(Fraction(value, scale)):.{digits}f}" for value in (low, high, step)]
    low_exact, high_exact, step_exact = map(Fraction, texts)
    points = floor((high_exact - low_exact) / step_exact) + 1
    (values,) = grid(with_sweeps(_campaign(trials=points), {"a.b": ":".join(texts)})).values()
    assert len(values) == points
    exact = [float(low_exact + k * step_exact) for k in range(points)]
    np.testing.assert_allclose(values, exact, rtol=1e-15, atol=1e-15 * max(map(abs, exact)))
    assert values[-1] <= float(high_exact) + 1e-9 * float(step_exact)


def _campaign(trials=12, **others):
    return Campaign("c.toml", "s", trials, 1, Expression("1"), **others)


def test_which_texts_are_sweeps():
    requested = {"a.b": " 1:5:0.5 ", "a.c": "1", "a.d": 2.0, "a.e": "file:a:b", "a.f": "1:5", "a.g": [1, 2]}
    options, sweeps = split_sweeps(SystemOptions(set=requested))
    assert sweeps == {"a.b": "1:5:0.5"}
    assert dict(options.set) == {name: value for name, value in requested.items() if name != "a.b"}


def test_several_sweeps_are_every_combination_beside_the_campaigns_own_grid(campaign):
    own = campaign('[draw.case]\ndistribution = "grid"\nvalues = [7, 8]\n', trials=24)
    swept = with_sweeps(own, {"a.b": "1:3:1", "a.c": "0:0.5:0.5"})
    rows = draw_table(swept).columns
    combinations = list(zip(rows["case"], rows["a.b"], rows["a.c"], strict=True))
    assert sorted(set(combinations)) == [(c, b, a) for c in (7, 8) for b in (1, 2, 3) for a in (0, 0.5)]
    assert {combinations.count(one) for one in combinations} == {2}
    assert swept.group is None


def test_grouping(campaign):
    assert with_sweeps(_campaign(trials=5), {"a.b": "1:5:1"}).group == "a.b"
    text = '[draw.case]\ndistribution = "choice"\nvalues = [1, 2]\n[group]\nby = "case"\n'
    assert with_sweeps(campaign(text, trials=10), {"a.b": "1:5:1"}).group == "case"
    assert with_sweeps(_campaign(trials=101), {"a.b": "0:100:1"}).group is None  # more than groups can be


def test_a_sweep_takes_the_place_of_a_fixed_value(campaign):
    swept = with_sweeps(campaign('[set]\n"a.b" = 3\n"a.c" = 4\n', trials=4), {"a.b": "0:1:1"})
    assert dict(swept.settings) == {"a.c": 4}


@pytest.mark.parametrize(
    ("sweep", "words"),
    [
        ("a.b=1:5:0", "the step 0 is not positive"),
        ("a.b=1:5:-1", "the step -1 is not positive"),
        ("a.b=5:1:1", "high = 1 is not above low = 5"),
        ("a.b=1:1:1", "high = 1 is not above low = 1"),
        ("a.b=1:inf:1", "not a sweep; write low:high:step with three numbers"),
        ("a.b=1:2:3", "the step 3 reaches no value beyond low = 1"),
        ("a.b=0:1:1e-12", "1e+12 points, at most 10000 are accepted"),
        ("a.b=1:7:1", "12 trials do not fill a grid of 7 points; give a multiple of 7: trials 7 or 14"),
        ("a.b=1:20:1", "12 trials do not fill a grid of 20 points; give a multiple of 20: trials 20"),
        ("mass=1:2:1", "not a component's variable; give component.variable"),
        ("d.x=1:2:1", "the campaign draws it in every trial; omit this sweep"),
    ],
)
def test_what_cannot_be_swept_is_refused(campaign, sweep, words):
    name, _, text = sweep.partition("=")
    declared = campaign('[draw."d.x"]\ndistribution = "uniform"\nlow = 0\nhigh = 1\n', trials=12)
    with pytest.raises(perilune.InputError) as caught:
        with_sweeps(declared, {name: text})
    line = str(caught.value)
    assert line.startswith(f"set: {sweep}: ")
    assert words in line
    assert "\n" not in line


def test_requirements_and_sweeps_do_not_go_together(campaign):
    text = '[requirement.lands]\nexpression = "success"\nshare = 0.9\nconfidence = 0.9\n'
    with pytest.raises(perilune.InputError, match="requirements, and their verdicts need independent trials"):
        with_sweeps(campaign(text), {"a.b": "1:2:1"})


@pytest.fixture(scope="module")
def folder(fmus, tmp_path_factory):
    """Run a sweep of five masses, four trials each, from the command line."""
    place = tmp_path_factory.mktemp("sweep") / "results"
    words = ["--compare", "guidance=analytic_guidance", "--trials", "20", "--set", SWEEP, "--output", str(place)]
    assert main(["batch", SYSTEM, "--campaign", "paper", *words]) == 0
    return place


def test_a_sweep_flies_what_a_grid_of_the_campaigns_file_flies(folder, tmp_path):
    own = (SYSTEMS / SYSTEM / "campaigns" / "paper.toml").read_text()
    own += f'[draw."{MASS}"]\ndistribution = "grid"\nvalues = [900, 925, 950, 975, 1000]\n[group]\nby = "{MASS}"\n'
    (tmp_path / "own.toml").write_text(own)
    declared = perilune.batch(SYSTEM, tmp_path / "own.toml", trials=20, compare=ONE)
    swept = perilune.merge(folder)
    assert swept.table().equals(declared.table())
    assert json.dumps(swept.to_json()["variants"]) == json.dumps(declared.to_json()["variants"])
    assert list(swept.summary["analytic_guidance"].groups) == ["900", "925", "950", "975", "1000"]
    assert perilune.batch(SYSTEM, "paper", trials=20, compare=ONE, set={MASS: "900:1000:25"}).summary == swept.summary


def test_the_sweep_is_in_the_manifest_and_in_the_results(folder, capsys):
    assert json.loads((folder / "manifest.json").read_text())["campaign"]["sweep"] == {MASS: "900:1000:25"}
    assert json.loads((folder / "summary.json").read_text())["sweep"] == {MASS: "900:1000:25"}
    resume = ["batch", SYSTEM, "--campaign", "paper", "--compare", "guidance=analytic_guidance", "--trials", "20"]
    resume += ["--output", str(folder), "--resume"]
    assert main([*resume, "--set", SWEEP]) == 0
    capsys.readouterr()
    for other, actual in (
        (["--set", f"{MASS}=900:1000:100"], f"campaign.sweep.{MASS} was 900:1000:25, is 900:1000:100;"),
        ([], 'campaign.sweep was {"plant.initial_mass": "900:1000:25"}, is nothing;'),
    ):
        assert main([*resume, *other]) == 2
        line = capsys.readouterr().err
        assert f"holds another campaign: {actual}" in line
        assert line.count("\n") == 1


def test_a_trial_of_a_sweep_flies_again(folder, tmp_path, capsys):
    """By the page's command, which names the folder, and with the options of the batch; the mass is its point's."""
    page, replayed = tmp_path / "page.html", tmp_path / "replay.json"
    assert main(["merge", str(folder), "--report", str(page)]) == 0
    assert f"perilune replay {folder} " in page.read_text()
    words = ["--compare", "guidance=analytic_guidance", "--trials", "20", "--set", SWEEP]
    assert main(["replay", SYSTEM, "7", "--campaign", "paper", *words, "--json", str(replayed)]) == 0
    row = perilune.merge(folder).table().to_pylist()[7]
    assert row[f"draw.{MASS}"] == 950
    repeated = json.loads(replayed.read_text())["metrics"]
    assert repeated["position_error"] == row["metric.position_error"]
    stored = perilune.replay(folder, 7)
    assert stored.metrics["position_error"] == row["metric.position_error"]
    assert stored.differences == ()
    capsys.readouterr()


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (["run", SYSTEM, "--set", SWEEP], "'900:1000:25' is not a single value; give one value, in kg; sweeps"),
        (["batch", SYSTEM, "--campaign", "paper", "--set", f"{MASS}=900:1000"], "is not a single value"),
        (["rare", SYSTEM, "--campaign", "paper", "--set", SWEEP], "a study cannot sweep"),
        (["sensitivity", SYSTEM, "--campaign", "paper", "--base", "64", "--set", SWEEP], "a study cannot sweep"),
        (["batch", SYSTEM, "--campaign", "paper", "--trials", "20", "--set", "plant.mas=1:2:1"], "no such parameter"),
        (["batch", SYSTEM, "--campaign", "paper", "--draws", "d.parquet", "--set", SWEEP], "a sweep cannot be"),
    ],
)  # fmt: skip
def test_lines_of_the_command_line(fmus, command, words, capsys):
    assert main(command) == 2
    line = capsys.readouterr().err
    assert words in line
    assert line.count("\n") == 1
