"""`perilune run`: files, JSON and exit status, compared with a simulation in Python.

Truth: `perilune.simulate` with the same options; Python's json and csv modules.
"""

import csv
import json
import re
import shlex
import shutil

import pytest
from lxml import html

import perilune
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS

SYSTEM = "lunar_terminal_guidance"
pytestmark = pytest.mark.usefixtures("fmus")


def test_writes_what_the_api_returns(tmp_path, capsys):
    output, report = tmp_path / "new" / "flight.csv", tmp_path / "new" / "flight.html"
    options = ["--use", "guidance=astar_modified_guidance", "--set", "plant.initial_position[2]=3000", "--step", "0.5"]
    assert main(["run", SYSTEM, *options, "--output", str(output), "--report", str(report), "--json", "-"]) == 0
    actual = json.loads(capsys.readouterr().out)
    expected = perilune.simulate(
        SYSTEM, use={"guidance": "astar_modified_guidance"}, set={"plant.initial_position[2]": 3000}, step=0.5
    )
    assert actual["status"] == expected.status == "finished"
    assert actual["final"] == expected.final()
    assert actual["parameters"]["plant.initial_position[2]"] == 3000.0
    assert actual["system_sha256"] == expected.provenance["system_sha256"]
    with output.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["plant.position[3]"]) for row in rows] == expected["plant.position[3]"].tolist()
    assert report.read_text().lower().startswith("<!doctype html")


def test_says_how_it_ended(capsys):
    assert main(["run", SYSTEM]) == 0
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    assert lines[0] == f"{SYSTEM}: completed at t = 207.2 s, 2073 samples"
    assert [line.rpartition(": ")[2] for line in lines[1:]] == ["PASS", "PASS, tightest"]
    assert captured.err == ""
    assert main(["run", SYSTEM, "--stop-time", "2"]) == 1
    captured = capsys.readouterr()
    lines = captured.out.splitlines()
    words = "limits violated: distance from the target, velocity error"
    assert captured.err == f"perilune: ssp_systems/{SYSTEM}/SystemStructure.ssd: {words}\n"
    assert lines[0] == f"{SYSTEM}: stop time reached at t = 2 s, 21 samples"
    assert [line.rpartition(": ")[2] for line in lines[1:]] == ["FAIL, tightest", "FAIL"]


def test_json_to_a_file_and_talk_to_the_terminal(tmp_path, capsys):
    assert main(["run", SYSTEM, "--stop-time", "1", "--json", str(tmp_path / "a" / "run.json")]) == 1
    assert "stop time reached" in capsys.readouterr().out
    assert json.loads((tmp_path / "a" / "run.json").read_text())["rows"] == 11


def test_packed_and_unpacked_fly_alike(tmp_path):
    from perilune.common.paths import BUILD

    finals = []
    for system in (SYSTEM, BUILD / "ssp" / f"{SYSTEM}.ssp"):
        target = tmp_path / "x.json"
        assert main(["run", str(system), "--parameters", "noisy.ssv", "--stop-time", "30", "--json", str(target)]) == 1
        finals.append(json.loads(target.read_text())["final"])
    assert finals[0] == finals[1]


def test_a_folder_of_a_shipped_systems_name_is_meant_by_its_path(tmp_path, monkeypatch, capsys):
    """Truth: the stop time that the folder's SSD has, 2 s."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(SYSTEMS / SYSTEM, tmp_path / SYSTEM)
    ssd = tmp_path / SYSTEM / "SystemStructure.ssd"
    ssd.write_text(re.sub('stopTime="[^"]*"', 'stopTime="2"', ssd.read_text(encoding="utf-8")), encoding="utf-8")
    assert main(["run", f"./{SYSTEM}"]) == 1
    assert "stop time reached at t = 2 s" in capsys.readouterr().out
    assert main(["batch", f"./{SYSTEM}", "--campaign", "paper", "--trials", "2", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["steps"] == 20  # of 0.1 s


@pytest.mark.slow
def test_the_command_of_a_page_writes_the_page_again(tmp_path):
    options = ["--use", "guidance=astar_guidance", "--set", "plant.initial_mass=900", "--stop-time", "20"]
    faults = ["--fault", "plant.mass=bias:1@2", "--record", "plant.initial_mass", "--require", "time < 300"]
    first, second = tmp_path / "first.html", tmp_path / "second.html"
    assert main(["run", "lunar_terminal_guidance", *options, *faults, "--report", str(first)]) in (0, 1)
    page = first.read_text(encoding="utf-8")
    (command,) = html.document_fromstring(page).xpath("//p[@class='repeat']/code/text()")
    assert main([*shlex.split(command)[1:], "--report", str(second)]) in (0, 1)
    assert second.read_text(encoding="utf-8") == page
