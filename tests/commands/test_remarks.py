"""Remarks of commands on their results: FMUs older than their source, inputs without a value, meanings of statuses.

Truth: files before and after an edit; the declared meanings of statuses; the signals of the simulation.
"""

import shutil
from contextlib import chdir
from pathlib import Path

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.fmus_src.export.sources import NAME, find_changed_source, record_source

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """Return a folder with a new system and its Python FMUs."""
    folder = tmp_path_factory.mktemp("exported")
    with chdir(folder):
        perilune.new_system("axis")
        perilune.export("axis/blocks.py", flavour="python")
    return folder


@pytest.fixture
def own(exported, tmp_path, monkeypatch):
    """Return the user's folder with a copy of them."""
    shutil.copytree(exported, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def edited(file):
    file.write_text(f"{file.read_text()}\n# edited\n", encoding="utf-8")


def test_an_edit_without_export_is_told_by_every_verb_that_flies(own, capsys):
    verbs = (
        ["run", "axis"],
        ["batch", "axis", "--campaign", "dispersed", "--trials", "1", "--stop-time", "1", "--workers", "1"],
        ["stability", "axis"],
    )
    main(verbs[0])
    assert capsys.readouterr().err == ""
    edited(own / "axis" / "blocks.py")
    for verb in verbs:
        main(verb)
        lines = capsys.readouterr().err.splitlines()
        words = (
            "axis/blocks.py: has changed since axis_control, axis_plant were exported; perilune export axis/blocks.py"
        )
        assert lines.count(f"perilune: {words}") == 1
    perilune.export("axis/blocks.py", flavour="python")
    main(verbs[0])
    assert capsys.readouterr().err == ""


def test_fmus_are_found_beside_the_folder_of_a_system(own, monkeypatch, capsys):
    elsewhere = own / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    assert main(["run", "../axis", "--use", "control=axis_control"]) == 0
    edited(own / "axis" / "blocks.py")
    assert main(["run", "../axis"]) == 0
    assert f"{own / 'axis' / 'blocks.py'}: has changed since" in capsys.readouterr().err
    (own / "build").rename(own / "built")
    assert main(["run", "../axis"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"{elsewhere}/build/fmus/" in line
    assert f"{own}/build/fmus/" in line
    assert "perilune export FILE.py" in line


def test_the_record_names_no_place_of_this_machine(own):
    record = own / "build" / "fmus" / NAME
    first = record.read_bytes()
    assert str(own).encode() not in first
    perilune.export("axis/blocks.py", flavour="python")
    assert record.read_bytes() == first
    fmu = own / "build" / "fmus" / "python" / "axis_plant.fmu"
    edited(own / "axis" / "blocks.py")
    assert find_changed_source(fmu) == (own / "axis" / "blocks.py",) * 2
    fmu.write_bytes(fmu.read_bytes() + b"x")  # another FMU in its place: of it nothing is known
    assert find_changed_source(fmu) is None
    (own / "axis" / "blocks.py").unlink()
    assert find_changed_source(own / "build" / "fmus" / "python" / "axis_control.fmu") is None
    record.write_text("no JSON")
    assert find_changed_source(fmu) is None
    record_source(own / "build" / "fmus", own / "axis" / "heavy.ssv", [fmu])
    assert find_changed_source(fmu) is None


def test_inputs_that_a_system_of_others_does_not_declare(own, capsys):
    file = own / "axis" / "SystemStructure.ssd"
    lines = [line for line in file.read_text().splitlines() if 'name="rate" kind="input"' not in line]
    lines = [line for line in lines if 'startConnector="rate"' not in line]
    file.write_text("\n".join(lines), encoding="utf-8")
    assert main(["run", "axis"]) == 1  # without the rate it does not settle
    out = capsys.readouterr().out
    assert "note: control.rate: input not declared in the description, keeps its start" in out.splitlines()
    assert main(["run", "lunar_descent_2d"]) == 0  # of this repository, as it was meant
    assert "note:" not in capsys.readouterr().out


def test_a_status_is_said_with_its_meaning(own, capsys):
    words = ["--set", "control.largest_torque=0.02", "--stop-time", "20"]
    result = perilune.simulate("axis", set={"control.largest_torque": 0.02}, stop_time=20.0)
    values = result["control.status"]
    assert main(["run", "axis", *words]) == 1  # too early for the limits at the end
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("control.status")]
    assert line.startswith("control.status: 1 (torque at its limit) from t = 0 s, ")
    assert values[0] == values.max() == 1
    assert f"{100 * (values == 1).mean():.2g} %" in line or "all of the samples" in line
    batch = ["batch", "axis", "--campaign", "dispersed", "--trials", "2", "--workers", "1"]
    assert main([*batch, *words]) == 0
    assert "\ncontrol.status 1, torque at its limit\n" in capsys.readouterr().out


def test_a_replay_says_what_it_wrote(own, capsys):
    command = ["replay", "axis", "2", "--campaign", "dispersed", "--trials", "3", "--stop-time", "5"]
    assert main([*command, "--output", "replay.parquet"]) == 1
    lines = capsys.readouterr().out.splitlines()
    outcome = lines.index("default: trial 2: stop_time, no success")
    assert [line.split()[0] for line in lines[outcome + 1 : -1]] == ["settled", "final_angle", "largest_torque"]
    assert lines[-1] == "written: replay.parquet"
    assert Path("replay.parquet").is_file()
