"""FMUs that end their process or do not return: `run` names FMU and time, batches continue, no process remains.

Truth: the FMU's source, which misbehaves as requested by the test; the same campaign with an FMU that does not.
"""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import perilune
from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.runner import run_batch
from perilune.analysis.cli import main
from perilune.analysis.runtime.process import children
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.common.errors import InputError
from tests.support.builders import component, document, pack, system
from tests.support.foreign.odd_fmu import COUNTS, Call, Deed, odd_fmu
from tests.support.foreign.odd_fmu import ENDS as ENDS_OF_ODD
from tests.support.lengths import either

pytestmark = pytest.mark.flies

ENDS = {
    "SEGFAULT": "crashed|its process ended by SIGSEGV",
    "ABORT": "crashed|its process ended by SIGABRT",
    "OVERFLOW": "crashed|its process ended by SIGSEGV",
    "EXIT_0": "crashed|its process ended with exit status 0",
    "EXIT_1": "crashed|its process ended with exit status 1",
    "EXIT_AT_ONCE": "crashed|its process ended with exit status 3",
    "KILL_GROUP": "crashed|its process ended by SIGKILL",
    "SCRIBBLE": "crashed|its process sent answers that cannot be read",
    "LEAVE_ORPHAN": "crashed|its process ended by SIGABRT",
}


@pytest.mark.parametrize("deed", ENDS)
def test_a_run_keeps_what_was_flown(tmp_path, deed):
    whole = perilune.simulate(odd_fmu(tmp_path, "good"), stop_time=1.0)
    status, how = ENDS[deed].split("|")
    flight = perilune.simulate(odd_fmu(tmp_path, DEED=Deed[deed], IN=Call.STEP), stop_time=1.0)
    assert flight.status == status
    assert flight.message.endswith(f": {how}")
    if deed == "SCRIBBLE":  # which continues until it is ended
        return
    assert flight.message.startswith("odd: on the way to t = 0.75 s: ")
    assert flight.time.tolist() == [0.0, 0.25, 0.5]
    assert np.array_equal(flight["odd.y"], whole["good.y"][:3])


CALLS = {
    Call.CONSTRUCTION: "odd: cannot be instantiated: its process ended by SIGSEGV",
    Call.INSTANTIATION: "odd: cannot be instantiated: its process ended by SIGSEGV",
}


@pytest.mark.parametrize("call", CALLS)
def test_an_fmu_that_cannot_be_instantiated_is_refused(tmp_path, call):
    path = odd_fmu(tmp_path, DEED=Deed.SEGFAULT, IN=call)
    with pytest.raises(InputError, match=CALLS[call]):
        perilune.simulate(path)


def test_a_crash_in_the_initialisation_leaves_no_row(tmp_path):
    flight = perilune.simulate(odd_fmu(tmp_path, DEED=Deed.ABORT, IN=Call.INITIALISATION))
    assert (flight.status, flight.time.size) == ("crashed", 0)
    assert flight.message == "odd: in the initialisation: its process ended by SIGABRT"
    flight.report(tmp_path / "page.html")
    assert flight.message in (tmp_path / "page.html").read_text()


FREEING = [
    ("SEGFAULT", "ended by SIGSEGV"),
    ("EXIT_0", "ended with exit status 0"),
    ("HANG", "did not end within 1.5 s"),
]


@pytest.mark.parametrize(("deed", "how"), FREEING)
def test_what_happens_when_it_is_freed_is_a_note(tmp_path, deed, how):
    with pytest.warns(UserWarning, match=f"^odd: when it was terminated and freed, its process {how}$"):
        flight = perilune.simulate(odd_fmu(tmp_path, DEED=Deed[deed], IN=Call.FREEING))
    assert flight.status == "stop_time"


def test_a_batch_notes_once_what_happens_when_it_is_freed(tmp_path):
    """Between flights and after the last one: none of its trials is to blame for it."""
    with pytest.warns(UserWarning, match="odd") as noted:
        trials, _ = fly(tmp_path / "batch", 1, 20, DEED=Deed.SEGFAULT, IN=Call.FREEING)
    freed, renewed = (str(warning.message) for warning in noted)
    assert freed == "odd: when it was terminated and freed, its process ended by SIGSEGV"
    assert "odd: one process per simulation" in renewed
    assert "when its reset was tested, its process ended by SIGSEGV; " in renewed
    assert trials.statuses == ["stop_time"] * 20
    assert not trials.messages


def test_a_call_that_does_not_return_has_a_limit(tmp_path):
    flight = perilune.simulate(odd_fmu(tmp_path, DEED=Deed.HANG, IN=Call.STEP), stop_time=1.0, call_timeout=0.5)
    assert flight.status == "hung"
    assert flight.message == "odd: on the way to t = 0.75 s: a call did not return for 0.5 s"
    with pytest.raises(InputError, match="cannot be instantiated: a call did not return"):
        perilune.simulate(odd_fmu(tmp_path, DEED=Deed.HANG, IN=Call.INSTANTIATION), call_timeout=0.5)


def test_memory_has_a_limit(tmp_path):
    flight = perilune.simulate(odd_fmu(tmp_path, DEED=Deed.GROW, IN=Call.STEP), stop_time=1.0, memory=0.2)
    assert flight.status == "out_of_memory"
    assert flight.message == "odd: on the way to t = 0.75 s: its process exceeded its memory limit"
    assert perilune.simulate(odd_fmu(tmp_path, DEED=Deed.GROW, IN=Call.STEP), stop_time=0.75).status == "stop_time"


MEMORY = {
    Deed.FILL: "out_of_memory|its process ended by SIGABRT near its memory limit",
    Deed.RESERVE: "crashed|its process ended by SIGSEGV",
}


@pytest.mark.parametrize("deed", MEMORY)
def test_allocations_fail_near_the_limit_of_memory(tmp_path, deed):
    """Limit of 0.2 GB: one fills 0.18 and gives up, the other uses 1 GB without a look at whether it has it."""
    flight = perilune.simulate(odd_fmu(tmp_path, DEED=deed, IN=Call.STEP), stop_time=1.0, memory=0.2)
    status, how = MEMORY[deed].split("|")
    assert (flight.status, flight.message) == (status, f"odd: on the way to t = 0.75 s: {how}")


def fly(folder, workers, trials=200, **quirks):
    """Return the trials of a batch, and those with a count of 13."""
    folder.mkdir()
    fmu = odd_fmu(folder, **quirks)
    (folder / "c.toml").write_text(COUNTS.format(name="odd", trials=trials))
    options = SystemOptions(stop_time=1.0, step=0.25, call_timeout=10.0, memory=0.2)
    plan = read_plan(fmu, str(folder / "c.toml"), options)
    return run_batch(plan, workers=workers).trials["default"], plan.draws.columns["odd.count"] == 13


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    return fly(tmp_path_factory.mktemp("good") / "batch", 1)[0]


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("deed", either([*ENDS, "CORRUPT", "GROW"], ["SEGFAULT", "EXIT_0", "CORRUPT"]))
def test_a_batch_goes_on(tmp_path, good, deed, workers):
    """Also with heap corruption, after which it is another trial that may end the process: it flies again."""
    trials, bad = fly(tmp_path / "batch", workers, COUNTED=13, IN=Call.STEP, DEED=Deed[deed])
    assert 0 < bad.sum() < bad.size
    assert np.array_equal(trials.metrics["last"][~bad], good.metrics["last"][~bad])
    assert [status for status, late in zip(trials.statuses, bad, strict=True) if not late] == ["stop_time"] * int(
        sum(~bad)
    )
    expected = "out_of_memory" if deed == "GROW" else "crashed"
    if deed != "CORRUPT":  # of which glibc need not become aware
        assert {trials.statuses[trial] for trial in np.flatnonzero(bad)} == {expected}
        assert not trials.success[bad].any()
        assert set(trials.messages) == set(np.flatnonzero(bad))


def test_a_reset_that_crashes_is_not_trusted(tmp_path, good):
    """Each trial has new instances then."""
    trials, _ = fly(tmp_path / "batch", 1, 30, DEED=Deed.SEGFAULT, IN=Call.RESETTING)
    assert trials.statuses == ["stop_time"] * 30
    assert np.array_equal(trials.metrics["last"], good.metrics["last"][:30])


def test_a_format_without_its_arguments_ends_one_flight_only(tmp_path, good):
    """FMI 2.0 makes messages formats: in the second flight they are taken as they are."""
    trials, _ = fly(tmp_path / "batch", 1, 20, DEED=Deed.LOG, IN=Call.STEP)
    assert trials.statuses == ["stop_time"] * 20
    assert np.array_equal(trials.metrics["last"], good.metrics["last"][:20])
    assert perilune.simulate(tmp_path / "batch" / "odd.fmu", stop_time=1.0).status == "crashed"


def test_what_fmus_print_and_log_is_no_order_to_the_terminal(tmp_path, capfd):
    assert (
        main(["run", str(odd_fmu(tmp_path, DEED=Deed.LOG_CONTROLS, IN=Call.STEP)), "--stop-time", "1", "--log", "info"])
        == 0
    )
    (line, _) = [line for line in capfd.readouterr().err.splitlines() if line.startswith("log: ")]
    assert line == "log: t = 0.75 s: odd: OK (any): \\x1b[31mred\\u009b\\u202e"


def test_what_fmus_print_has_an_end(tmp_path):
    fmu = odd_fmu(tmp_path, DEED=Deed.PRINT, IN=Call.INITIALISATION)
    command = [sys.executable, "-m", "perilune", "run", str(fmu), "--stop-time", "1"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=100)
    lines = done.stderr.splitlines()
    assert lines[:2] == ["odd: \\x1b[31mline 0", "odd: \\x1b[31mline 1"]
    assert lines[1000:] == ["odd: ... and 999000 more lines"]


# By the name of the component; several share the output of their process.
NAMES = {
    ("odd",): "odd",
    ("perilune",): "component perilune",
    ("Log: t = 1 s",): "component Log: t = 1 s",
    ("a", "b"): "a, b",
    ("a", "b", "c", "d", "e"): "a, b, c and 2 more",
}


@pytest.fixture
def heard(monkeypatch, capfd):
    """Yield a reader of printed lines, with a flight server of the test's own too."""
    monkeypatch.setattr(children, "_server", None)
    yield lambda: capfd.readouterr().err.splitlines()
    children.start_server().close()


def test_what_fmus_print_never_looks_like_a_line_of_ours(tmp_path, heard):
    odd_fmu(tmp_path, DEED=Deed.SAY, IN=Call.STEP)
    for names, label in NAMES.items():
        root = system(*(component(name, "odd", ENDS_OF_ODD) for name in names))
        path = pack(tmp_path / "s.ssp", tmp_path, document(root, stop=1.0))
        assert perilune.simulate(path, open_inputs="start").status == "stop_time"
        said = [f"{label}: perilune: all is well", f"{label}: and more"]
        assert heard() == said * (2 * len(names))  # of each in two steps


def test_an_fmu_that_closes_the_files_of_its_process(tmp_path, heard):
    """Its channel, too, through which its message would go: it is said in words, and no traceback of ours."""
    for call in (Call.INITIALISATION, Call.STEP):
        path = odd_fmu(tmp_path, DEED=Deed.CLOSE, IN=call)
        for log in (None, "info"):
            flight = perilune.simulate(path, stop_time=1.0, log=log)
            assert flight.status == "crashed"
            assert flight.message.startswith("odd: ")  # and when it was heard of, which may be later
            assert flight.message.endswith(": it closed its channel")
            assert heard() == []


@pytest.mark.parametrize("call", [Call.CONSTRUCTION, Call.INSTANTIATION, Call.INITIALISATION, Call.STEP])
@pytest.mark.parametrize("deed", either([Deed.SEGFAULT, Deed.EXIT_0, Deed.HANG], [Deed.EXIT_0]))
def test_what_is_refused_before_anything_flies(tmp_path, capsys, call, deed):
    """By `validate` and by `prepare`, which try an FMU with its declared values."""
    fmu = odd_fmu(tmp_path, DEED=deed, IN=call)
    (tmp_path / "c.toml").write_text(COUNTS.format(name="odd", trials=30))
    prepare = ["prepare", str(fmu), "--campaign", str(tmp_path / "c.toml"), "--output", str(tmp_path / "out")]
    for command in (["validate", str(fmu)], [*prepare, "--step", "0.25", "--stop-time", "1"]):
        assert main([*command, "--call-timeout", "1"]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert "odd: its test alone, with its declared values, failed: " in line
    assert not (tmp_path / "out" / "manifest.json").exists()
