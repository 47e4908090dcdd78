"""Worst margin of a loop over the draws of a campaign.

Truth: a gain margin in closed form (nominal margin divided by the drawn gain); margins and poles by python-control on
support/loops/exact_systems.py at the worst draws and on a grid over the box; repeated studies of the reported points.
"""

import json
import shlex

import numpy as np
import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.stability.loops.margin_values import LoopMargins
from perilune.analysis.studies.worst.objective import margin_columns, margin_objective
from perilune.common.errors import InputError
from tests.support.lengths import LONG
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_systems import coupled_pair, late_double_integrator
from tests.support.loops.studies import UNSTABLE_ABOVE

DECIBEL = 20.0 / np.log(10.0)
SIGMA, FLIGHTS = 0.1, 100
HEAD = 'system = "{name}"\ntrials = 6\nseed = 11\n'
GAIN = f"""
[draw.gain]
distribution = "normal"
mean = 1
sigma = {SIGMA}

[derive]
"control.proportional" = "0.02 * gain"
"control.derivative" = "0.22 * gain"
"""
TAIL = """
[metric.position]
expression = "plant.position"
reduction = "final"

[success]
expression = "abs(position) < 100"
"""


def uniform(name, low, high):
    return f'\n[draw."{name}"]\ndistribution = "uniform"\nlow = {low}\nhigh = {high}\n'


BOX = {"control.proportional": (0.01, 0.03), "control.derivative": (0.15, 0.6)}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Return a writer of a campaign of draws."""

    def write(draws, name="late_double_integrator", tail=TAIL):
        path = tmp_path_factory.mktemp("campaign") / "c.toml"
        path.write_text(HEAD.format(name=name) + draws + tail)
        return str(path)

    return write


@pytest.fixture(scope="module")
def late(exact_fmus, tmp_path_factory):
    return str(late_double_integrator().packed(tmp_path_factory.mktemp("late"), exact_fmus))


@pytest.fixture(scope="module")
def box(written):
    return written("".join(uniform(name, *ends) for name, ends in BOX.items()))


@pytest.fixture(scope="module")
def actual(late, box, tmp_path_factory):
    folder = tmp_path_factory.mktemp("found")
    return folder, perilune.worst(late, box, loop="loop", flights=FLIGHTS, workers=1, output=folder)


def exact(draws):
    return late_double_integrator(
        proportional=draws["control.proportional"], derivative=draws["control.derivative"]
    ).loop


@pytest.mark.slow  # test_the_least_disk_margin_of_a_box searches, too
def test_a_gain_margin_in_closed_form(late, written):
    """With a gain K in the loop the margin is the nominal one over K, least at the most that K may be."""
    gain, _, _ = crossings(late_double_integrator().loop)
    assert gain[np.argmin(abs(np.log(gain)))] > 1.0
    result = perilune.worst(late, written(GAIN), loop="loop", margin="gain", flights=FLIGHTS, workers=1)
    maximum = 1.0 + 3.0 * SIGMA
    assert result.worst["draws"]["gain"] == pytest.approx(maximum, rel=1e-6)
    assert result.worst["value"] == pytest.approx(DECIBEL * np.log(np.min(gain) / maximum), abs=1e-3)
    assert result.worst["value"] == result.values()["worst"] == result.worst["metrics"]["loop.gain_margin_db"]
    assert result.worst_random["value"] > result.worst["value"]
    assert result.random_trials == FLIGHTS // 5


def test_the_least_disk_margin_of_a_box(actual):
    _, result = actual
    worst = result.worst
    assert worst["value"] == pytest.approx(disk_margin(exact(worst["draws"])), rel=1e-4)
    ends = [np.linspace(*BOX[name], 5) for name in BOX]
    grid = [dict(zip(BOX, place, strict=True)) for place in np.array(np.meshgrid(*ends)).reshape(2, -1).T]
    assert worst["value"] <= min(disk_margin(exact(draws)) for draws in grid) * (1.0 + 1e-4)
    assert result.flights <= FLIGHTS


@pytest.mark.skipif(not LONG, reason="a hundred studies each, under make long")
@pytest.mark.parametrize("margin", ["delay", "phase", "modulus"])
def test_other_margins(late, box, margin):
    result = perilune.worst(late, box, loop="loop", margin=margin, flights=FLIGHTS, workers=1)
    loop = exact(result.worst["draws"])
    _, phase, frequency = crossings(loop)
    truth = {
        "phase": np.degrees(np.min(abs(phase))),
        "delay": np.min(phase % (2.0 * np.pi) / frequency),
        "modulus": np.min(abs(1.0 + loop(np.exp(1j * np.linspace(1e-3, np.pi, 20_001))))),
    }
    assert result.worst["value"] == pytest.approx(truth[margin], rel=1e-4)
    assert result.worst["value"] <= result.worst_random["value"]


def test_the_worst_is_studied_again(actual, late, box, capsys):
    """Dispersed over the file of draws, and by the reported command, which runs the whole study."""
    folder, result = actual
    report = perilune.stability(late, loops=["loop"], campaign=box, draws=folder / "worst.parquet", workers=1)
    spread = report.loops[0].dispersion
    margins = [item.disk for item in spread.margins]
    assert margins == [result.worst["value"], result.worst_random["value"]]
    assert spread.worst == 0
    document = json.loads((folder / "worst.json").read_text())
    assert document == result.json_document(folder)
    command, *arguments = shlex.split(document["replay"])
    assert command == "perilune"
    assert main([*arguments, "--json", "-"]) in (0, 1)
    (loop,) = json.loads(capsys.readouterr().out)["loops"]
    assert loop["disk_margin"] == pytest.approx(result.worst["value"], rel=1e-6)
    assert spread.replay.replace(" --trial 0", "") == document["replay"].replace(" --trial 0", "")


@pytest.mark.slow
def test_among_unstable_loops_the_largest_multiplier_is_worst(late, written, tmp_path, capsys):
    """The derivative gain up to 2 s, of which 1.58 s is stable: no margin is left, and poles say how unstable."""
    campaign = written(uniform("control.derivative", 0.5, 2.0))
    assert UNSTABLE_ABOVE < 2.0
    out = tmp_path / "out"
    line = ["worst", late, "--campaign", campaign, "--loop", "loop", "--margin", "gain", "--flights", str(FLIGHTS)]
    assert main([*line, "--workers", "1", "--output", str(out), "--require", "worst > 0"]) == 1
    captured = capsys.readouterr()
    assert captured.out.startswith("gain margin of loop at there (dB): worst unstable in ")
    assert f"replay: perilune stability {late}" in captured.out
    assert "--require: worst > 0: not met" in captured.err
    worst = json.loads((out / "worst.json").read_text())["worst"]
    truth = [np.max(abs(late_double_integrator(derivative=d).closed)) for d in np.linspace(0.5, 2.0, 31)]
    assert worst["draws"]["control.derivative"] == pytest.approx(2.0, rel=1e-6)
    assert worst["value"] == worst["metrics"]["loop.gain_margin_db"] == "unstable"
    assert worst["metrics"]["loop.largest_multiplier"] == pytest.approx(max(truth), rel=1e-6)
    value = pyarrow.parquet.read_table(out / "flights.parquet")["value"].to_numpy().max()
    assert value == pytest.approx(max(truth) - 1.0, rel=1e-5)


@pytest.mark.skipif(not LONG, reason="a hundred studies of two channels, under make long")
def test_of_several_channels_the_least_counts(exact_fmus, written, tmp_path):
    pair = str(coupled_pair().packed(tmp_path, exact_fmus))
    tail = TAIL.replace("plant.position", "plant.position[1]")
    campaign = written(uniform("control.derivative[1]", 0.2, 1.0), "coupled_pair", tail)
    result = perilune.worst(pair, campaign, loop="loop", flights=FLIGHTS, workers=1, output=tmp_path / "out")
    table = pyarrow.parquet.read_table(tmp_path / "out" / "flights.parquet")
    channels = [table[f"metric.loop[{place}].disk_margin"].to_numpy() for place in (1, 2)]
    minimum = np.minimum(*channels)
    assert result.worst["value"] == minimum.min() == -table["value"].to_numpy().max()
    assert np.ptp(channels[0]) > 0.01


@pytest.mark.slow
def test_workers_do_not_matter(actual, late, box):
    _, result = actual
    other = perilune.worst(late, box, loop="loop", flights=FLIGHTS, workers=2)
    assert other.json_document() == result.json_document()
    assert other.flown.values.tobytes() == result.flown.values.tobytes()


def test_draws_that_cannot_be_studied_are_the_worst(exact_fmus, written, tmp_path):
    """The point is where the mass has swung to -5 mm, which it does not where it starts too near to 0."""
    system = late_double_integrator()
    ssd = system.ssd.replace('time="20.0"', 'signal="plant.position" falls_to="-0.005"')
    assert ssd != system.ssd
    path = type(system)(system.name, ssd, system.loop, system.step).packed(tmp_path, exact_fmus)
    campaign = written(uniform("plant.start", 0.05, 2.0))
    result = perilune.worst(path, campaign, loop="loop", flights=FLIGHTS, workers=1)
    assert result.worst["value"] is None
    assert "plant.position never falls to -0.005" in result.reason
    assert f"failed: {result.reason}" in result.lines()
    assert result.flights < FLIGHTS


def test_what_is_worse_than_what():
    """A draw without a margin, loops that are more and less unstable, margins from the least on, none to be reached."""
    draws = [None, (-1, 1.3), (-1, 1.1), (0.0, 1.0), (0.5, 0.9), (40.0, 0.9), (np.inf, 0.9)]
    rows = [
        draw and [LoopMargins(*[np.inf] * 2, draw[0], draw[0], np.inf, stable=draw[0] >= 0.0, largest=draw[1])]
        for draw in draws
    ]
    objective = margin_objective("loop", "there", ["loop"], "disk")
    values = objective(margin_columns(["loop"], rows), np.array([row is not None for row in rows]))
    assert (np.diff(values) < 0.0).all()
    assert np.isfinite(values[1:]).all()
    reported = [objective.fact(objective.size(value)) for value in values]
    assert reported == [None, "unstable", "unstable", 0.0, 0.5, 40.0, "unlimited"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"metric": "position"}, "metric: cannot be combined with loop; give one of them"),
        ({"compare": {"control": "x"}}, "compare: cannot be combined with loop; select the FMU with use"),
        ({"timeout": 3.0}, "timeout: cannot be combined with loop"),
        ({"loop": None, "point": "there"}, "point: there: needs loop; give loop"),
        ({"loop": None, "at": 3.0}, "at: 3.0: needs loop"),
        ({"loop": "lop"}, "loops: lop: the SSD declares no such loop"),
        ({"point": "here"}, "point: here: loop has no such point; give there"),
        ({"margin": "nyquist"}, "margin: nyquist: no such choice"),
        ({"flights": 10}, "flights: 10: too few"),
        ({"noise_trial": -1}, "noise_trial"),
    ],
)
def test_refusals(late, box, options, words):
    with pytest.raises(InputError, match=words):
        perilune.worst(late, box, workers=1, **({"loop": "loop", "flights": 100} | options))
