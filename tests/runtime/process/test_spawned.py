"""Child processes on operating systems without fork, tested here with spawned processes.

Truth: the same simulations in this process, and the FMU's source. None of these tests runs on Windows.
"""

from __future__ import annotations

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.runtime.process import children
from perilune.analysis.runtime.system.options import SystemOptions
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu
from tests.support.lengths import either

pytestmark = pytest.mark.flies
ENDS = {
    "SEGFAULT": ("crashed", "its process ended by SIGSEGV"),
    "EXIT_0": ("crashed", "its process ended with exit status 0"),
    "HANG": ("hung", "a call did not return for 1 s"),
    "GROW": ("out_of_memory", "its process exceeded its memory limit"),
}


@pytest.fixture(autouse=True)
def no_fork(monkeypatch):
    monkeypatch.setattr(children, "CAN_FORK", False)
    monkeypatch.setattr(children, "start_server", None)


@pytest.mark.parametrize("deed", either(list(ENDS), ["SEGFAULT"]))
def test_a_run_keeps_what_was_flown(tmp_path, deed):
    whole = perilune.simulate(odd_fmu(tmp_path, "good"), stop_time=1.0, in_process=True)
    memory = 0.6 if deed == "GROW" else 4.0  # of which a process with everything loaded has a third
    bad = odd_fmu(tmp_path, DEED=Deed[deed], IN=Call.STEP)
    flight = perilune.simulate(bad, stop_time=1.0, call_timeout=1.0, memory=memory)
    status, how = ENDS[deed]
    assert (flight.status, flight.message) == (status, f"odd: on the way to t = 0.75 s: {how}")
    assert np.array_equal(flight["odd.y"], whole["good.y"][:3])


def test_a_batch_goes_on(tmp_path, capfd):
    (tmp_path / "c.toml").write_text(COUNTS.format(name="odd", trials=12))
    fmu = odd_fmu(tmp_path, DEED=Deed.SEGFAULT, IN=Call.STEP, COUNTED=13)
    plan = read_plan(fmu, str(tmp_path / "c.toml"), SystemOptions(stop_time=1.0, step=0.25))
    trials = run_batch(plan, workers=2).trials["default"]
    count = plan.draws.columns["odd.count"]
    assert trials.statuses == ["crashed" if each == 13 else "stop_time" for each in count]
    good = count != 13
    np.testing.assert_allclose(trials.metrics["last"][good], 2 * 0.5 + count[good] + 1, rtol=1e-14)


def test_what_it_prints_is_no_order_to_the_terminal(tmp_path, capfd):
    flight = perilune.simulate(odd_fmu(tmp_path, DEED=Deed.PRINT, IN=Call.INITIALISATION), stop_time=1.0)
    assert flight.status == "stop_time"
    lines = capfd.readouterr().err.splitlines()
    assert (lines[0], lines[1000]) == ("odd: \\x1b[31mline 0", "odd: ... and 999000 more lines")
