"""Exit status of every verb: 0 if all limits are met, 1 if not, 2 if refused; also in the help and the docs.

Truth: the rule, row by row, for simulations with results known by construction (a thrust of 1e308 N ends a simulation,
one second is too short to land, contact has not occurred).
"""

from __future__ import annotations

import re
import shlex
import shutil
import zipfile
from dataclasses import replace

import pytest

from perilune.analysis.cli import main
from perilune.analysis.verbs.options.verbs import VERBS
from perilune.common.paths import SYSTEMS, shipped_fmu
from tests.support.builders import write_zip
from tests.support.loops.exact_systems import late_double_integrator

SYSTEM = "lunar_terminal_guidance"
FAILURES = {name: verb.not_met for name, verb in VERBS.items() if verb.not_met}
ONE = f"{SYSTEM} --campaign paper --compare guidance=analytic_guidance --workers 1"
FAILING = "--fault guidance.thrust_acceleration=override:1e308@1"  # every flight gives infinity
STUDY = f"{ONE} --samples 100"
SEARCH = f"{ONE} --metric flight_time --flights 100"
NO_CONTACT = "landing_mission --stop-time 1"

# Arguments and the status that they end with; {folder} is created below.
ROWS = [
    ("list", 0),
    ("list --json {folder}", 2),
    (f"describe {SYSTEM}", 0),
    ("describe nothing", 2),
    (f"validate {SYSTEM}", 0),
    ("validate nothing", 2),
    (f"run {SYSTEM}", 0),
    (f"run {SYSTEM} --stop-time 1", 1),  # the limits at the end
    (f"run {NO_CONTACT}", 1),  # limits of a contact that is not there
    (f"run {SYSTEM} --require 'time < 1'", 1),
    (f"run {SYSTEM} {FAILING}", 1),
    ("run {folder}/short", 1),  # finished is never true until its stop time
    ("run {folder}/short --stop-time 5", 0),  # which is what was asked for
    ("run nothing", 2),
    (f"batch {ONE} --trials 2", 0),
    (f"batch {ONE} --trials 2 --require 'analytic_guidance.success_rate < 1'", 1),
    (f"batch {ONE} --trials 2 {FAILING}", 1),
    (f"batch {SYSTEM} --campaign {{folder}}/undecided.toml --workers 1", 1),
    (f"batch {ONE} --trials 0", 2),
    (f"prepare {ONE.removesuffix(' --workers 1')} --trials 2 --output {{folder}}/new", 0),
    (f"prepare {ONE.removesuffix(' --workers 1')} --trials 2 --output {{folder}}/prepared", 2),
    (f"replay {ONE.replace(' --', ' 1 --', 1).removesuffix(' --workers 1')} --trials 2", 0),
    (f"replay {ONE.replace(' --', ' 1 --', 1).removesuffix(' --workers 1')} --trials 2 {FAILING}", 1),
    (f"sensitivity {ONE} --base 32", 0),
    (f"sensitivity {ONE} --base 3", 2),
    ("shard {folder}/prepared 0", 0),
    ("shard {folder}/failing 0", 1),
    ("shard {folder}/prepared 7", 2),
    ("merge {folder}/flown", 0),
    ("merge {folder}/flown --require 'analytic_guidance.success_rate < 1'", 1),
    ("merge {folder}/failed", 1),
    ("merge {folder}/empty", 2),
    ("replay {folder}/flown 1", 0),
    ("replay {folder}/flown 1 --require 'metric.flight_time < 1'", 1),
    ("replay {folder}/failed 1", 1),
    ("replay {folder}/flown 2", 2),
    ("compare {folder}/flown", 0),
    ("compare {folder}/empty", 2),
    ("show {folder}/empty", 2),
    ("diff {folder}/one.csv {folder}/one.csv --tolerance 0", 0),
    ("diff {folder}/one.csv {folder}/other.csv --tolerance 0.1", 1),
    ("diff {folder}/one.csv nothing.csv", 2),
    ("verify flat_moon_lander", 0),
    ("verify {folder}/changed.fmu", 1),
    ("verify nothing", 2),
    (f"rare {STUDY} --failure 'flight_time > 100'", 0),
    (f"rare {STUDY} --failure 'flight_time > 100' --require 'probability < 0.5'", 1),
    (f"rare {ONE} --samples 1", 2),
    (f"worst {SEARCH}", 0),
    (f"worst {SEARCH} --require 'worst < 1'", 1),
    (f"worst {ONE} --flights 1", 2),
    ("stability {folder}/late.ssp", 0),
    ("stability {folder}/strict.ssp", 1),  # a modulus margin of 0.99 is asked for
    (f"stability {SYSTEM}", 2),
    ("design law diveev_2013", 0),
    ("design law nothing", 2),
    ("design search nothing", 2),
    ("design transfer", 0),
    ("design transfer --dry-mass 590", 1),
    ("design transfer --intervals 50", 2),
    ("new block made_here", 0),
    ("new block Made", 2),
    ("new system made_here", 0),
    ("new system Made", 2),
    ("design bound --speed 0", 2),
    ("design bounds lunar_landing --campaign terminal_box", 2),
    ("docs --json {folder}", 2),
    ("export forming_filter --flavour python", 0),
    ("export nothing", 2),
    ("compose lunar_terminal_guidance", 0),
    ("compose nothing", 2),
    ("benchmark --steps 10", 2),  # of an earlier release
]
ELSEWHERE = {
    "design search": "0 and 1: test_synthesize.py",
    "docs": "0: test_docs.py",
    "show": "0: tests/show/test_process.py",
    "design bound": "0 and 1: test_plan.py",
    "design bounds": "0 and 1: test_trial_bounds.py",
}

UNDECIDED = f"""
system = "{SYSTEM}"
trials = 2
seed = 1

[metric.flight_time]
expression = "time"
reduction = "final"

[success]
expression = "flight_time > 0"

[requirement.lands]
expression = "success"
share = 0.99
confidence = 0.9
"""


@pytest.fixture(scope="module")
def folder(fmus, exact_fmus, tmp_path_factory):
    """Write a campaign's folder in each state, a system that never finishes, a loop within and beyond its limits."""
    root = tmp_path_factory.mktemp("verbs")
    (root / "empty").mkdir()
    (root / "undecided.toml").write_text(UNDECIDED)
    for name, height in (("one", 1), ("other", 2)):
        (root / f"{name}.csv").write_text(f"time,height\n0,{height}\n")
    for name, words in (
        ("prepared", ""), ("failing", FAILING), ("flown", ""), ("failed", FAILING)
    ):  # fmt: skip
        command = ONE.removesuffix(" --workers 1").split()
        verb = "prepare" if name in ("prepared", "failing") else "batch"
        assert main([verb, *command, "--trials", "2", *words.split(), "--output", str(root / name)]) in (0, 1)
    with zipfile.ZipFile(shipped_fmu("flat_moon_lander", "native")) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    write_zip(root / "changed.fmu", files | {"documentation/index.html": b""})
    short = root / "short"
    shutil.copytree(SYSTEMS / SYSTEM, short)
    text = (short / "SystemStructure.ssd").read_text()
    text = re.sub(r'stopTime="[^"]*"', 'stopTime="5"', re.sub(r"<Limits.*?</Limits>", "", text, flags=re.DOTALL))
    (short / "SystemStructure.ssd").write_text(text)
    loop = late_double_integrator()
    loop.packed(root, exact_fmus).rename(root / "late.ssp")
    strict = replace(loop, ssd=loop.ssd.replace("<Point", '<Limits modulus_margin="0.99"/>\n<Point', 1))
    strict.packed(root, exact_fmus).rename(root / "strict.ssp")
    return root


@pytest.mark.parametrize(("command", "status"), ROWS)
def test_the_status_of_a_command(command, status, folder, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    actual = main(shlex.split(command.format(folder=folder)))
    said = capfd.readouterr().err
    assert actual == status, said
    if status:
        assert said.startswith("perilune: "), "nobody is told why"
    if status == 2:
        assert said.count("\n") == 1


def test_the_table_has_every_verb_with_every_status_that_it_can_end_with():
    known = {(verb, status) for command, status in ROWS for verb in VERBS if f"{command} ".startswith(f"{verb} ")}
    for verb in VERBS:
        can = {0, 2} | ({1} if verb in FAILURES else set())
        left_out = {0, 1} if verb in ELSEWHERE else set()
        assert {status for name, status in known if name == verb} | left_out >= can, verb


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_a_verb(verb, capsys):
    with pytest.raises(SystemExit) as stop:
        main([*verb.split(), "--help"])
    assert stop.value.code == 0
    words = " ".join(capsys.readouterr().out.split())
    one = f"{FAILURES[verb]}, or interrupted" if verb in FAILURES else "interrupted"
    assert words.endswith(f"Exit status: 0: success. 1: {one}. 2: wrong input, or a result could not be written.")
