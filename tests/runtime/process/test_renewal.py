"""FMUs that leave data in their thread, process or folder: each trial equals a trial in a new process.

Truth: the closed form of `coupled.c` and its Python kin, p (1 + the state that the two steps of a first instance find),
for C's rand() and Python's generator with their first numbers; the default environment of IEEE 754.
"""

import ctypes
import random
import re

import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.instances.renewal import Renewal
from perilune.analysis.runtime.process.resets import find_verdict
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.analysis.runtime.system.options import SystemOptions
from tests.support.foreign.coupled import CAMPAIGN, Trace, coupled_fmu, coupled_module, coupled_system
from tests.support.lengths import either

pytestmark = pytest.mark.flies
TRIALS = either(24, 8)
TIMES = {"stop_time": 0.5, "step": 0.25}


def met_numbers() -> dict[object, float]:
    """Return what both steps of a first instance meet in sum; the first numbers of C's generator from ctypes."""
    libc = ctypes.CDLL(None)
    libc.srand(1)
    generators = {seed: random.Random(seed) for seed in (0, 5)}
    return {
        Trace.NOTHING: 0,
        Trace.ROUNDING: 0,
        Trace.TRAPS: 0,
        Trace.FLUSH: 0,
        Trace.FILES: 1 + 2,
        Trace.RAND: sum(libc.rand() % 1000 for _ in range(2)),
        Trace.GLOBAL: 0 + 1,
        Trace.FOLDER: 0 + 1,
        Trace.LOCALE: 0 + 1,
        Trace.ENVIRONMENT: 0 + 1,
        "module global": 0 + 1,
        "seeded generator": sum(generators[5].random() for _ in range(2)),
        "generator": sum(generators[0].random() for _ in range(2)),
    }


def name_of(kind):
    return kind.name if isinstance(kind, Trace) else str(kind)


MET = met_numbers()
VERDICTS = {
    Trace.NOTHING: (Renewal.RESET, ""),
    Trace.ROUNDING: (Renewal.RESET, ""),
    Trace.TRAPS: (Renewal.RESET, ""),
    Trace.FLUSH: (Renewal.RESET, ""),
    Trace.FILES: (Renewal.PROCESS, "its folder has changed: trace"),
    Trace.RAND: (Renewal.PROCESS, "after a reset its results differ from those of a fresh instance"),
    Trace.GLOBAL: (Renewal.INSTANCE, "after a reset its results differ from those of a fresh instance"),
    Trace.FOLDER: (Renewal.PROCESS, "it changes the working folder of its process"),
    Trace.LOCALE: (Renewal.PROCESS, "it changes the locale of its process"),
    Trace.ENVIRONMENT: (Renewal.PROCESS, "it changes the environment of its process: COUPLED"),
    Trace.CLOCK: (Renewal.IRREPRODUCIBLE, "after a reset .*; two processes simulate it with different results"),
}


def make(folder, kind):
    return coupled_fmu(folder, kind) if isinstance(kind, Trace) else coupled_module(folder, kind)


def trials(fmu, folder, trial_count=TRIALS, **options):
    """Return the columns p and last of a campaign."""
    campaign = folder / "campaign.toml"
    name = "Coupled" if fmu.name == "Coupled.fmu" else "coupled"
    campaign.write_text(CAMPAIGN.format(trials=trial_count).replace("coupled", name))
    table = perilune.batch(fmu, campaign, **TIMES, **options).to_pandas()
    assert set(table["status"]) == {"stop_time"}
    return table[f"draw.{name}.p"].to_numpy(), table["metric.last"].to_numpy()


@pytest.mark.filterwarnings("ignore:.*one process per simulation")
@pytest.mark.parametrize("kind", [*MET], ids=name_of)
def test_one_worker_and_two_have_the_trials_of_a_process_each(tmp_path, kind):
    fmu = make(tmp_path, kind)
    for workers in (1, 2):
        p, last = trials(fmu, tmp_path, workers=workers)
        np.testing.assert_allclose(last, p * (1.0 + MET[kind]), rtol=1e-14)


@pytest.mark.parametrize("trace", VERDICTS, ids=name_of)
def test_the_verdict_says_what_renews_an_fmu(tmp_path, trace):
    renewal, reason = VERDICTS[trace]
    verdict = find_verdict(load_fmu(coupled_fmu(tmp_path, trace).read_bytes(), "coupled.fmu"), SystemOptions())
    assert verdict.renewal is renewal
    assert re.fullmatch(reason, verdict.reason)


def test_processes_for_each_simulation_are_noted_once_with_reason_and_cost(tmp_path):
    fmu = coupled_fmu(tmp_path, Trace.FILES, resets=False)  # of no other test here: it would have been noted
    note = (
        "coupled: one process per simulation, since a second simulation in the same process differs: "
        "its folder has changed: trace"
    )
    with pytest.warns(UserWarning, match=note) as noted:
        [trials(fmu, tmp_path, workers=workers) for workers in (2, 1)]
    assert len(noted) == 1
    assert re.search(r"; \d+ ms each$", str(noted[0].message))
    assert f"{fmu}: {note.removeprefix('coupled: ')}" in perilune.validate(fmu)[0].notes


@pytest.mark.filterwarnings("ignore:.*one process per simulation")
def test_all_traces_in_one_system_change_no_table(tmp_path):
    """Against one worker; dask's are tried in `test_dask.py`."""
    system, campaign = coupled_system(tmp_path)
    tables = [
        perilune.batch(system, campaign, **options).to_pandas()
        for options in ({"workers": 1}, {"workers": 2}, {"workers": 2, "engine": "processes"})
    ]
    assert tables[0].equals(tables[1])
    assert tables[0].equals(tables[2])


@pytest.mark.parametrize("trace", [Trace.ROUNDING, Trace.TRAPS, Trace.FLUSH], ids=name_of)
def test_threads_of_this_process_keep_their_floating_point_environment(tmp_path, trace):
    fmu = coupled_fmu(tmp_path, trace)
    for workers, engine in ((1, None), (2, "threads")):
        p, last = trials(fmu, tmp_path, workers=workers, engine=engine, in_process=True)
        assert np.array_equal(last, p)
    libm = ctypes.CDLL("libm.so.6")
    assert (libm.fegetround(), libm.fegetexcept(), np.float64(5e-324) * 1.0) == (0, 0, 5e-324)


def test_in_this_process_a_note_says_that_trials_depend_on_each_other(tmp_path):
    with pytest.warns(UserWarning, match="a simulation in this process depends on earlier ones: its folder has"):
        trials(coupled_fmu(tmp_path, Trace.FILES), tmp_path, 3, workers=1, in_process=True)


def test_a_folder_of_an_earlier_version_is_read(tmp_path):
    """Its manifest has verdicts without a renewal."""
    fmu, folder = coupled_fmu(tmp_path, Trace.GLOBAL), tmp_path / "out"
    _, last = trials(fmu, tmp_path, 4, workers=1, output=folder)
    manifest = folder / "manifest.json"
    text, count = re.subn(r'"renewal": *"instance"', '"resets": false', manifest.read_text())
    assert count == 1
    manifest.write_text(text)
    assert perilune.replay(folder, 2).metrics["last"] == last[2]
