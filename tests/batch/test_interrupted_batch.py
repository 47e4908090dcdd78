"""Ctrl-C during a batch: the first trials are there, as the whole batch has them.

Truth: the same trials of a batch that was not interrupted, bit for bit.
"""

import numpy as np
import pytest
from tqdm import tqdm

import perilune
from perilune.analysis.batch import runner
from perilune.analysis.batch.stored import read_batch
from perilune.analysis.cli import main
from tests.support.interrupts import interrupted_when
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM, CAMPAIGN = "lunar_terminal_guidance", "paper"


@pytest.fixture
def counted(monkeypatch):
    """How many trials a batch's progress has counted."""

    class Counted(tqdm):
        count = 0

        def update(self, n=1):
            Counted.count += n
            return super().update(n)

    monkeypatch.setattr(runner, "progress_bar", lambda **options: Counted(**options, disable=True))
    return Counted


@pytest.mark.parametrize(
    ("flavour", "workers", "trials"),
    [("native", 1, 3000), ("native", 2, 3000), pytest.param("python", 2, 150, marks=pytest.mark.slow)],
)
def test_the_first_trials_are_those_of_the_whole(counted, tmp_path, capsys, flavour, workers, trials):
    out = tmp_path / "out"
    command = ["batch", SYSTEM, "--campaign", CAMPAIGN, "--flavour", flavour, "--trials", str(trials)]
    end = 5.0 if flavour == "python" else 400.0  # s; Python FMUs take a hundred times as long for a step
    command += ["--stop-time", str(end)]
    with interrupted_when(lambda: counted.count >= (60 if flavour == "python" else 400)):
        status = main([*command, "--workers", str(workers), "--output", str(out)])
    captured = capsys.readouterr()
    stored = read_batch(out)
    first = len(next(iter(stored.draws.values())))
    assert status == 1
    assert f"perilune: interrupted: the first {first} of {trials} trials were flown" in captured.err
    assert f"written: {out}" in captured.out
    assert 0 < first < trials
    assert stored.document["planned_trials"] == trials
    asked = min(first, either(first, 200))
    whole = perilune.batch(SYSTEM, CAMPAIGN, flavour=flavour, trials=asked, stop_time=end)
    for name, found in whole.trials.items():
        assert stored.variants[name].trial[:asked].tolist() == list(range(min(asked, first)))
        for metric, values in found.metrics.items():
            assert np.array_equal(stored.variants[name].metrics[metric][:asked], values[:first], equal_nan=True)
    for name, column in whole.plan.draws.columns.items():
        assert np.array_equal(stored.draws[name][:asked], column[:first])
