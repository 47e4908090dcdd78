"""`--fault` of `perilune run` and `batch`, and faults in `perilune compare`: signals, exit status, pages.

Truth: rows of a ramp computed by hand; `perilune.simulate` and `batch` with `perilune.Fault`; the documented exit
status: 2 and one line for wrong input.
"""

import json
import re

import pyarrow.parquet
import pytest

import perilune
from perilune.analysis.cli import main
from tests.support.builders import component, connection, document, pack, system
from tests.support.pages.checks import text_of

CAMPAIGN = """
system = "s"
trials = 4
seed = 1
[draw.t0]
distribution = "uniform"
low = 0.3
high = 0.7
[metric.last]
expression = "gain.y"
reduction = "final"
[success]
expression = "last > 5"
"""
HELD = '[fault.held]\nconnector = "ramp.y"\nkind = "freeze"\nstart = "t0"\nwhen = "t0 > 0.5"\n'
BIAS = "gain.u=bias:0.5@0.25..0.75"


@pytest.fixture(scope="module")
def folder(tiny_folder, tmp_path_factory):
    actual = tmp_path_factory.mktemp("option")
    parts = (
        component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer"),
        component("gain", "gain", "input u Real m; output y Real m"),
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean"),
    )
    wires = connection("ramp.y", "gain.u") + connection("ramp.flag", "whole.b") + connection("ramp.count", "whole.n")
    pack(actual / "s.ssp", tiny_folder / "native", document(system(*parts, connections=wires)))
    (actual / "bare.toml").write_text(CAMPAIGN)
    (actual / "held.toml").write_text(CAMPAIGN + HELD)
    return actual


@pytest.fixture
def batch(folder):
    return ["batch", str(folder / "s.ssp"), "--workers", "1", "--campaign"]


def test_run(folder, tmp_path, capsys):
    faults = ["--fault", BIAS, "--fault", "whole.b=override:true@.5", "--fault", "ramp.count=freeze@0.25..1"]
    output, page = tmp_path / "f.parquet", tmp_path / "f.html"
    command = ["run", str(folder / "s.ssp"), *faults, "--output", str(output), "--report", str(page)]
    assert main(command) == 0
    said = [BIAS, "whole.b=override:true@0.5", "ramp.count=freeze@0.25..1"]
    assert capsys.readouterr().out.splitlines() == [
        "s: stop time reached at t = 1 s, 5 samples", f"with faults: {'; '.join(said)}", f"written: {output}, {page}",
    ]  # fmt: skip
    table = pyarrow.parquet.read_table(output)
    assert table["gain.u"].to_pylist() == [1.0, 2.0, 2.5, 2.5, 3.0]
    assert table["gain.y"].to_pylist() == [3.0, 6.0, 7.5, 7.5, 9.0]
    assert table["ramp.y"].to_pylist() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert table["whole.c"].to_pylist() == [False, False, True, True, True]
    assert table["whole.m"].to_pylist() == [0, 1, 1, 1, 4]
    assert json.loads(table.schema.metadata[b"perilune"])["faults"] == said
    assert f"Faults: {'; '.join(said)}." in text_of(page.read_text())


def test_provenance_can_be_flown_again(folder, capsys):
    command = ["run", str(folder / "s.ssp"), "--json", "-"]
    assert main([*command, "--fault", "gain.u = bias:5e-1@.25..75e-2", "--fault", "ramp.y=freeze@0.1"]) == 0
    first = json.loads(capsys.readouterr().out)
    repeated = [token for text in first["faults"] for token in ("--fault", text)]
    assert main([*command, *repeated]) == 0
    assert json.loads(capsys.readouterr().out) == first
    fault = perilune.Fault("gain.u", "bias", 0.5, 0.25, 0.75)
    flown = perilune.simulate(folder / "s.ssp", faults=[fault, perilune.Fault("ramp.y", "freeze", start=0.1)])
    assert flown.provenance["faults"] == first["faults"]
    assert flown.final() == first["final"]


@pytest.mark.parametrize(
    ("fault", "says"),
    [
        (
            "gain.u",
            "--fault: gain.u: not of the form COMPONENT.CONNECTOR=override|bias|freeze[:VALUE]@T[..T]; use this",
        ),
        ("gain.u=melt:1@0", "--fault: gain.u=melt:1@0: unknown kind melt; use one of override, bias, freeze"),
        ("gain.u=bias@0", "--fault: gain.u=bias@0: bias lacks its value; write bias:VALUE"),
        ("gain.u=freeze:1@0", "--fault: gain.u=freeze:1@0: a freeze has no value"),
        ("gain.u=bias:1@2..1", "--fault: gain.u=bias:1@2..1: empty window: the end, 1 s, is not after the start, 2 s"),
        (
            "gain.w=bias:1@0",
            "fault: gain.w: no component has such a connector; the nearest of 13 known names: gain.u, gain.y",
        ),
        ("whole.n=bias:.5@0", "fault: whole.n: 0.5 is not of type Integer; give a whole number"),
        ("whole.b=override:2@0", "fault: whole.b: 2 is not a Boolean; give true or false"),
    ],
)
def test_wrong_faults_are_refused_in_one_line(folder, batch, capsys, fault, says):
    for command in (["run", str(folder / "s.ssp")], [*batch, str(folder / "bare.toml")]):
        assert main([*command, "--fault", fault]) == 2
        captured = capsys.readouterr()
        assert captured.err.startswith(f"perilune: {says}")
        assert captured.err.count("\n") == 1
        assert captured.out == ""


def test_a_wrong_fault_of_a_campaign_is_refused_in_one_line(folder, batch, tmp_path, capsys):
    path = tmp_path / "c.toml"
    path.write_text(CAMPAIGN + HELD.replace("ramp.y", "ramp.x"))
    assert main([*batch, str(path)]) == 2
    problem = (
        "no component has such a connector; the nearest of 13 known names: ramp.y, ramp.flag, ramp.count, ramp.slope"
    )
    error = capsys.readouterr().err
    assert error.startswith(f"perilune: {path}: fault.held.connector: {problem}")
    assert error.count("\n") == 1


def test_batch_and_its_replay(folder, batch, tmp_path, capsys):
    command = [*batch, str(folder / "held.toml"), "--fault", BIAS]
    assert main([*command, "--output", str(tmp_path / "out"), "--report", str(tmp_path / "page.html")]) == 0
    said = f"with faults: held: ramp.y=freeze@t0 when t0 > 0.5; {BIAS}"
    assert capsys.readouterr().out.splitlines()[-2:] == [said, f"written: {tmp_path / 'out'}, {tmp_path / 'page.html'}"]
    assert f"Faults: {said.removeprefix('with faults: ')}." in text_of((tmp_path / "page.html").read_text())
    rows = pyarrow.parquet.read_table(tmp_path / "out" / "trials").to_pylist()
    expected = perilune.batch(folder / "s.ssp", str(folder / "held.toml"), faults=[perilune.Fault("gain.u", "bias",
                              0.5, 0.25, 0.75)], workers=1).table().to_pylist()  # fmt: skip
    assert repr(rows) == repr(expected)
    assert {row["fault.held"] for row in rows} == {True, False}
    for row in rows:
        file = tmp_path / f"{row['trial']}.parquet"
        options = ["--campaign", str(folder / "held.toml"), "--fault", BIAS]
        replay = ["replay", command[1], str(row["trial"]), *options, "--output", str(file)]
        assert main([*replay, "--json", "-"]) == 0
        actual = json.loads(capsys.readouterr().out)
        held = [f"ramp.y=freeze@{row['draw.t0']!r}"] if row["fault.held"] else []
        assert actual["faults"] == [*held, BIAS]
        assert actual["metrics"]["last"] == row["metric.last"]
        table = pyarrow.parquet.read_table(file)
        assert json.loads(table.schema.metadata[b"perilune"])["faults"] == actual["faults"]
        assert table["gain.y"][-1].as_py() == (row["metric.last"])
        assert main(replay) == 0
        assert f"with faults: {'; '.join(actual['faults'])}" in capsys.readouterr().out.splitlines()


def test_comparisons_say_which_faults_flew(folder, batch, tmp_path, capsys):
    runs = {
        "bare": ["bare.toml"],
        "held": ["held.toml"],
        "biased": ["bare.toml", "--fault", BIAS, "--fault", "ramp.y=freeze@0.5"],
    }
    for name, (campaign, *options) in runs.items():
        assert main([*batch, str(folder / campaign), *options, "--output", str(tmp_path / name)]) == 0
    says = {
        "bare": "without faults",
        "held": "with faults: held: ramp.y=freeze@t0 when t0 > 0.5",
        "biased": f"with faults: {BIAS}; ramp.y=freeze@0.5",
    }
    capsys.readouterr()
    page = tmp_path / "page.html"
    assert main(["compare", *(str(tmp_path / name) for name in runs), "--report", str(page)]) == 0
    assert capsys.readouterr().out.splitlines()[-4:-1] == [f"{name}: {words}" for name, words in says.items()]
    for name, words in says.items():
        assert f"{name}: {words}." in text_of(page.read_text())
    assert main(["compare", str(tmp_path / "biased"), "--report", str(page)]) == 0
    assert capsys.readouterr().out.splitlines()[-2] == says["biased"]
    assert f"W{says['biased'][1:]}." in text_of(page.read_text())
    assert main(["compare", str(tmp_path / "bare"), "--report", str(page)]) == 0
    reported = capsys.readouterr().out + text_of(page.read_text())
    assert not re.search("[Ww]ith(out)? faults", reported)


def test_help_has_the_form(capsys):
    for verb in ("run", "batch"):
        with pytest.raises(SystemExit) as stop:
            main([verb, "--help-all"])
        assert stop.value.code == 0
        words = " ".join(capsys.readouterr().out.split())
        assert "inject a fault, COMPONENT.CONNECTOR=override|bias|freeze[:VALUE]@T[..T], times in s" in words
