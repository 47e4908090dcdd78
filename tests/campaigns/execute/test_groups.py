"""Groups of consecutive trials without a return to Python, including trials that end early.

Truth: the same trials with a time limit, which are simulated one at a time; a replay of each trial.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.flight import group

SYSTEM = "lunar_terminal_guidance"
CASES = (0, 0, 1, 0, 2, 0, 0)  # 1 and 2: so much thrust from this time (s) on that numbers overflow
TRIALS = 2 * len(CASES)
CAMPAIGN = f"""
system = "{SYSTEM}"
trials = {TRIALS}
seed = 5
[draw.case]
distribution = "grid"
values = {list(CASES)}
[draw."plant.initial_mass"]
distribution = "uniform"
low = 9000
high = 11000
[fault.overflow]
connector = "allocation.thrust_acceleration"
kind = "override"
value = "1.5 * 10**308"
start = "case"
when = "case > 0"
[metric.lowest]
expression = "plant.position[3]"
reduction = "min"
[metric.share]
expression = "guidance.status == 1"
reduction = "mean"
[metric.left]
expression = "plant.mass / plant.initial_mass"
reduction = "final"
[record]
final = ["plant.position[1]"]
traces = "{{traces}}"
[success]
expression = "left > 0.5"
"""
pytestmark = pytest.mark.usefixtures("fmus")


def flown(folder, traces="none", **options):
    file = folder / "masses.toml"
    file.write_text(CAMPAIGN.format(traces=traces))
    return perilune.batch(SYSTEM, file, workers=1, stop_time=3.0, **options)


def texts(result):
    """Return every digit of every column, and the traces."""
    (trials,) = result.trials.values()
    return repr(result.table().to_pydict()), {
        trial: {name: values.tobytes() for name, values in traces.items()} for trial, traces in trials.traces.items()
    }


@pytest.mark.parametrize("traces", ["none", "failures", "all"])
@pytest.mark.parametrize("room", [group.RECORD_BYTES, 6000])
def test_the_same_as_one_at_a_time(tmp_path, monkeypatch, traces, room):
    monkeypatch.setattr(group, "RECORD_BYTES", room)  # of all flights, and of a few
    together, alone = flown(tmp_path, traces=traces), flown(tmp_path, traces=traces, timeout=1000.0)
    assert texts(together) == texts(alone)
    (trials,) = together.trials.values()
    assert [trial % len(CASES) for trial in sorted(trials.messages)] == [2, 4, 2, 4]
    assert all(re.search(r"(inf|nan) at t = [12]", message) for message in trials.messages.values()), trials.messages
    assert np.isnan(trials.metrics["share"]).tolist() == [not flown for flown in trials.flown.tolist()]


def test_each_is_its_replay(tmp_path):
    batch = flown(tmp_path, output=tmp_path / "out")
    for trial in (0, 2, 3, 5, 11):
        assert perilune.replay(tmp_path / "out", trial).differences == ()
    assert batch.summary["default"].trials == TRIALS
