"""Every command in the documentation runs with the documented result, in order, page by page.

Truth: the exit status of the console command. A command of several minutes is executed here only up to its first
simulation (options read, names resolved, system and campaign prepared); `make long` runs it completely.
"""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
from importlib import import_module
from itertools import pairwise
from pathlib import Path

import pytest

from perilune.analysis.cli import main
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.common.paths import ROOT
from tests.support.documented import documented, first_difference, page_text, printed_by, saved_files
from tests.support.lengths import LONG
from tests.support.pages.system_page import write_system

# Commands by how they begin, and where they are carried out instead.
SYSTEM_BY_HAND = "docs/write_a_system.md"
ELSEWHERE = {
    "make ": "the targets of the Makefile; those of README are what CI runs",
    "pip install": "tests/package/test_wheel.py installs the wheel",
    "dask ": "of other machines; tests/campaigns/execute/cluster/test_dask.py starts both here",
    "perilune batch --scheduler": "tests/campaigns/execute/cluster/test_dask.py flies there",
    "seq 0 3 | xargs": "tests/campaigns/execute/cluster/test_recipes.py",
    "python fly_hyperqueue.py": "tests/campaigns/execute/cluster/test_recipes.py",
    "sbatch ": "needs a SLURM controller; the page says what was tried",
    "job=$(sbatch ": "likewise",
    "perilune docs": "tests/verbs/test_docs.py",
    "perilune show": "tests/show/test_process.py; it ends with Ctrl-C only",
    "perilune export basilisk_": "tests/examples/test_basilisk.py, where Basilisk is installed",
    "perilune run lunar_landing --use plant=basilisk_moon_lander": "likewise",
    "perilune batch lunar_landing --campaign compare --use plant=basilisk_moon_lander": "likewise",
    "perilune run lunar_landing --parameters ideal.ssv --use guidance=analytic_exact_guidance": "likewise",
    "perilune diff ours.parquet basilisk.parquet": "likewise",
    "perilune run build/fmus/python/basilisk_orbiter.fmu": "likewise",
    "perilune run StateSpace.fmu": "tests/runtime/fmi3/test_systems.py, with the Reference-FMU",
    "LD_PRELOAD=": "of a host of the reader's own",
}
# Commands by what is in them, and why only `make long` carries them out.
TAKES_LONG = {
    "--campaign paper --output results": "6000 flights",
    "--campaign paper --trials 10000": "30 000 flights",
    "--campaign paper --parameters exact.ssv": "20 000 flights",
    "--trials 1000000": "a million flights",
    "--campaign choices": "14 000 flights",
    "--campaign slant_range": "6000 flights",
    "--campaign noisy": "30 000 flights, or 4000 of the orbit",
    "lunar_landing --campaign compare --parameters noisy.ssv --output": "6000 flights",
    "lunar_landing --campaign compare --parameters noisy.ssv --trials 50 --output": "300 flights, and their page",
    "lunar_landing --campaign compare --trials 50 --output ours": "300 flights of 320 s",
    "--set guidance.frozen_time_to_go=20": "half a minute; tests/docs/test_descent_laws_stability.py studies it",
    "--campaign laws_": "1800 to 3600 flights each; tests/docs/test_descent_laws_page.py flies rows of them",
    "perilune replay results": "what it is a trial of takes long",
    "perilune compare": "what it compares takes long, and so do its pages; see tests/commands/test_compare.py",
    "--campaign fixed_starts": "800 flights",
    "--campaign derivative": "120 flights of 8000 s",
    "earth_pointing --campaign dispersed": "200 flights of six revolutions",
    "earth_pointing --report": "six revolutions and their page",
    "earth_pointing --stop-time": "flights to nadir; tests/docs/test_earth_pointing_faults.py flies them",
    "earth_pointing --parameters moon.ssv": "four revolutions; tests/docs/test_lunar_orbiter.py flies them",
    "cubesat --campaign dispersed": "100 flights of three revolutions",
    "perilune run cubesat --report": "a flight and its page",
    "perilune stability cubesat": "two operating points of 650 states",
    "perilune stability flexible_slew": "five operating points; tests/ssp_systems/test_flexible_slew.py studies them",
    "export forming_filter --fmi 3": "compiles for all platforms; tests/export/fmi3 has FMUs of FMI 3.0",
    "--slot guidance=analytic_guidance,astar_guidance --expose": "compiles for all platforms",
    "run earth_pointing --use satellite=thin_air": "six revolutions",
    "earth_pointing --campaign dispersed --compare satellite=spacecraft,thin_air": "four flights of six revolutions",
    "design transfer --t7 78": "a plan and its page; tests/documents/of/test_plan_pages.py writes one",
    "satellite_pointing --campaign dispersed": "1600 flights and their page",
    "satellite_pointing --campaign agile": "800 flights",
    "robot_rendezvous --campaign seeds --parameters best.ssv --compare": "24 flights of 5000 s",
    "--parameters paper.ssv --compare jets=jet_allocation_quantised": "16 such flights",
    "--campaign cases": "192 entries",
    "--campaign tracking": "8000 flights",
    "--campaign contacts": "2000 flights of 67 minutes",
    "--campaign table1": "flights at a step of a hundredth of a second",
    "--campaign table2": "300 such flights",
    "--campaign robustness_angle": "410 such flights",
    "landing_mission": "67 minutes of flight and a page with all of it",
    "perilune stability entry_attitude": "six operating points, in air",
    "perilune stability earth_pointing": "two operating points of 650 states",
    "perilune stability orbital_attitude": "two operating points and their limit cycles",
    "robot_rendezvous --parameters paper.ssv --report": "nine channels and a sweep",
    "attitude --parameters paper.ssv --report good.html": "what first_flight.md does, too",
    "attitude_control.lead_time=": "a thin and an unstable loop with their pages, 20 s",
    "--campaign inertia --trials 20": "twenty linearisations",
    "--optimum": "direct multiple shooting; those with what they print take 2 s",
    "--direct": "a direct method; likewise",
    "perilune worst robot_rendezvous": "a hundred linearisations",
    "lunar_landing --parameters noisy.ssv --use": "320 s of flight with all sensors and a table of it",
    "lunar_landing --report": "320 s of flight and its page",
    "entry_attitude --report": "a flight through air and its page",
    "hover_transfer --parameters ideal.ssv --report": "a flight and its page",
    "guidance=analytic_guidance,neural_guidance": "twenty flights of a guidance in Python",
}
# Of commands whose pages show what they print, `make test` carries out all but those that take more than 10 s, ...
OUTPUT_TAKES_LONG = {
    "perilune worst robot_rendezvous": "a hundred linearisations, 14 s",
    "python train_network.py": "tests/test_neural_guidance.py trains it",
    "neural_guidance": "needs the network that the page trains",
    "python read_loop.py": "needs the data of a study before it",
    "export lunar_terminal_guidance --as-fmu": "compiles for all platforms",
    "lunar_terminal_guidance.fmu": "the FMU of the former",
}
# ... and of some all but the page.
PAGE_TAKES_LONG = (
    "perilune run landing_mission --parameters ideal.ssv",
    "perilune run lunar_landing --report",
    "perilune run cubesat --report",
)
# Of the help of verbs, those that a page has with what they print, and what reads their files.
OF_PAGES = {
    "perilune rare": "docs/studies/failures.md",
    "--draws long_flights": "tests/studies/rare/test_rare_study.py flies such a file",
    "perilune worst": "docs/studies/failures.md",
    "perilune stability robot_rendezvous": "docs/first_flight.md",
}
FAILS = (  # exit status 1
    "--fault 'torquers.dipole[1]=override:5@4000'",  # a fault that is not survived
    "lunar_descent_2d --parameters basic.ssv",  # the basic solution of a search
    "attitude_control.lead_time=",  # the thin and the unstable loop
    "--fault 'pulses.pulse_lengths[2]=override:0@60'",  # limits at the end
    "perilune batch rendezvous --campaign dispersed --trials 1000 --set",  # a requirement that is not met
    "perilune batch earth_pointing --campaign dispersed",  # likewise
    "perilune stability earth_pointing --set",  # an orbit, which no loop controls
    "perilune stability flexible_slew",  # one of its points is unstable
    "perilune replay results 7 --configuration network_operator_guidance",  # a limit of the system
    "--fault 'gyros.measured_angular_velocity[1]=bias:1e-4@100..200'",
    "perilune diff here.parquet there.parquet",  # of a fault
)
# Functions that begin the work of a verb, once all its arguments have been checked.
WORK = {
    "batch": ["verbs.batch.open_campaign"],
    "prepare": ["verbs.shard.open_campaign"],
    "sensitivity": ["studies.sensitivity.sensitivity"],
    "compare": ["verbs.compare.compare_folders"],
    "export": ["verbs.export.build_fmu", "verbs.export.build_system_fmu"],
    "design": ["verbs.plans.hover_study", "verbs.plans.landing_study", "verbs.bounds.bound_descents"],
    "replay": ["verbs.replay.replay_trial", "verbs.replay.replay_plan"],
    "run": ["verbs.run.fly"],
    "stability": ["verbs.stability.study"],
    "worst": ["verbs.worst.worst_margin", "verbs.worst.worst_case"],
}
ALIKE = ("describe", "list", "run", "stability")  # read nothing of the folder: once is enough
PLACES = documented()
_done: set[str] = set()


class ReadyError(Exception):
    """All is prepared, and the work would begin."""


def _ready(*_arguments, **_keywords):
    raise ReadyError


def _beginning(command: str, table) -> str | None:
    return next((words for words in table if words in command), None)


OF_SYSTEMS = "docs/systems/"  # pages whose commands are alike: `make test` takes every third of them
# Of these the commands take a third of a minute each: `make long` alone, but for those with what they print.
LONG_PAGES = (
    "docs/stability.md",
    "docs/guides/evidence.md",
    "docs/guides/neural_network_guidance.md",
    "docs/studies/failures.md",
    "docs/use_elsewhere.md",
)
EXECUTED = (
    PLACES
    if LONG
    else [
        *(page for page in PLACES if not page.startswith(OF_SYSTEMS)),
        *[page for page in PLACES if page.startswith(OF_SYSTEMS)][::3],
    ]
)


@pytest.mark.parametrize("place", EXECUTED)
def test_the_commands(place, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for name, content in saved_files(page_text(place)):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content, encoding="utf-8")
    if place == SYSTEM_BY_HAND:
        write_system(tmp_path)
    here = tmp_path
    printed = printed_by(page_text(place))
    for command in PLACES[place]:
        if any(command.startswith(words) for words in ELSEWHERE):
            continue
        expected = printed.get(command, [])
        is_compared = bool(expected) if command.startswith("perilune ") else command in printed
        if not LONG and place in LONG_PAGES and (not is_compared or _beginning(command, OUTPUT_TAKES_LONG)):
            continue
        if not LONG and place.endswith("--help") and _beginning(command, OF_PAGES):
            continue
        brief = not LONG and not command.startswith("perilune describe") and _beginning(command, TAKES_LONG) is not None
        if not command.startswith("perilune "):
            if not brief:
                here, output = _shell(command, here)
                assert not expected or first_difference(expected, output, "") is None, f"{command}\n{output}"
            continue
        words = shlex.split(command)[1:]
        if brief and _beginning(command, PAGE_TAKES_LONG):
            words, expected = _without_page(words, expected)
        elif brief and not expected:
            _prepare(words, monkeypatch)
            continue
        if command in _done:
            continue
        _done.update([command] if words[0] in ALIKE and "linear_guidance" not in command and not expected else [])
        status = 1 if _beginning(command, FAILS) else 0
        capsys.readouterr()
        assert main(words) == status, f"{command}\n{capsys.readouterr().err}"
        captured = capsys.readouterr()
        difference = first_difference(expected, captured.out, captured.err) if expected else None
        assert difference is None, f"{command}: {difference!r}\n{captured.err}{captured.out}"
        for option, value in pairwise(words):
            if option in ("--output", "--report", "--graph", "--json"):
                assert Path(value).exists(), command
    capsys.readouterr()


def _prepare(words: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Run the command up to the begin of its work."""
    with monkeypatch.context() as patch:
        for work in WORK[words[0]]:
            module, _, name = work.rpartition(".")
            patch.setattr(import_module(f"perilune.analysis.{module}"), name, _ready)
        with pytest.raises(ReadyError):
            main(words)


def _without_page(words: list[str], expected: list[str]) -> tuple[list[str], list[str]]:
    """Return the command without its page, and its output then."""
    at = words.index("--report")
    return words[:at] + words[at + 2 :], [line for line in expected if line != f"written: {words[at + 1]}"]


def _shell(command: str, here: Path) -> tuple[Path, str]:
    """Carry out a line of a shell in a folder; returns the folder it ends in, and its standard output."""
    line = f"set -e; python() {{ '{sys.executable}' \"$@\"; }}; {command}; pwd > '{here}/.place'"
    done = subprocess.run(["bash", "-c", line], cwd=here, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}\n{done.stderr}"
    return Path((here / ".place").read_text(encoding="utf-8").strip()), done.stdout


def test_every_verb_has_an_example():
    for name, verb in VERBS.items():
        assert any(f"{command} ".startswith(f"perilune {name} ") for command in verb.examples)


def test_the_targets_of_make():
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    named = [command for commands in PLACES.values() for command in commands if command.startswith("make ")]
    assert named
    assert {command.split()[1] for command in named} <= targets


def test_what_is_left_out_is_there_to_be_left_out():
    commands = [command for commands in PLACES.values() for command in commands]
    for words in (*ELSEWHERE, *TAKES_LONG, *OF_PAGES, *OUTPUT_TAKES_LONG, *PAGE_TAKES_LONG, *FAILS):
        assert any(words in command for command in commands), words
