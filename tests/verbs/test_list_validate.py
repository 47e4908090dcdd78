"""`perilune list` and `perilune validate`: available items, and their errors.

Truth: the catalogue, the folders on disk, documents altered in one place.
"""

import json

import pytest
from fmpy.validation import validate_fmu

from perilune.analysis.cli import main
from perilune.common.paths import BUILD, SYSTEMS
from perilune.fmus_src.catalogue import catalogue
from tests.support.builders import component, connection, document, pack, parameter_set, retouched, system
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")


def test_list(capsys):
    assert main(["list", "--json", "-"]) == 0
    actual = json.loads(capsys.readouterr().out)
    assert set(actual["systems"]) == {path.parent.name for path in SYSTEMS.glob("*/system.toml")}
    landing = actual["systems"]["lunar_terminal_guidance"]
    assert landing["parameter_sets"] == ["exact.ssv", "ideal.ssv", "noisy.ssv", "paper.ssv"]
    assert landing["campaigns"] == ["choices", "noisy", "paper", "slant_range"]
    assert set(catalogue()) <= set(actual["fmus"])
    assert "python" in actual["fmus"]["astar_guidance"]["built"]
    assert main(["list"]) == 0
    text = capsys.readouterr().out
    first = {line.split()[0] for line in text.splitlines() if line}  # some names stand in the lines of others
    assert {*catalogue(), "lunar_terminal_guidance"} <= first
    assert "noisy.ssv" in text


def test_everything_of_ours_is_valid(capsys):
    paths = [str(path) for path in sorted(BUILD.glob("fmus/*/*.fmu"))[::24]]  # all of them: test_fmus_elsewhere.py
    assert len(paths) > 4
    paths += [str(path) for path in sorted(SYSTEMS.glob("*/*.ssv"))]
    paths += [str(path) for path in sorted(SYSTEMS.glob("*/campaigns/*.toml"))[:: either(1, 6)]]
    paths += ["lunar_terminal_guidance", str(BUILD / "ssp" / "lunar_terminal_guidance.ssp")]
    assert main(["validate", *paths]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert captured.out.count(": OK\n") == len(paths)


def test_notes_of_a_system(tiny_folder, tmp_path, capsys):
    left = component("left", "cross", "input b Real m; output ya Real m; output yb Real m")
    right = component("right", "cross", "input a Real m; input b Real m; output ya Real m; output yb Real m")
    wires = connection("left.ya", "right.a") + connection("right.ya", "left.b") + connection("left.yb", "right.b")
    path = pack(tmp_path / "s.ssp", tiny_folder / "python", document(system(left, right, connections=wires)))
    assert main(["validate", str(path), "--json", "-"]) == 0
    (actual,) = json.loads(capsys.readouterr().out)
    assert actual["problems"] == []
    assert actual["notes"] == [
        "left.a: input not declared in the description, keeps 0.25",
        "right.ya -> left.b: read one step late",
    ]
    assert main(["validate", str(path)]) == 0
    assert capsys.readouterr().out.count("note: ") == 2


def test_every_problem_has_its_line(tiny_folder, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    tiny = tiny_folder / "python"
    (tmp_path / "good.ssv").write_text(parameter_set("a=Real:1"))
    (tmp_path / "bad.ssv").write_text(parameter_set("a=Real:1; a=Real:2"))
    (tmp_path / "bad.fmu").write_bytes(b"x")
    (tmp_path / "bad.toml").write_text("system = ")
    retouched(tiny / "gain.fmu", tmp_path / "odd.fmu", lambda text: text.replace('unit="m"', 'unit="ell"', 1))
    names = ["good.ssv", "bad.ssv", "bad.fmu", "bad.toml", "odd.fmu", "gone.ssv", "gone.toml", "gone.fmu", "gone"]
    assert main(["validate", *names, "--strict"]) == 2
    captured = capsys.readouterr()
    assert captured.out == "good.ssv: OK\nodd.fmu: note: the FMU proposes no stop time: 1 s is used\n"
    lines = captured.err.splitlines()
    assert len(lines) == 8, captured.err
    for name, line in zip(names[1:], lines, strict=True):
        assert line.startswith(f"perilune: {name}"), line
        assert "; " in line


@pytest.mark.parametrize("name", ["a.b[1,2].c_", "der(slope)", "'q !'", "slo pe", "1slope", "a[x]", "a..b", "a[1][2]"])
def test_rules_of_names_are_those_of_fmpy(tiny, tmp_path, capsys, name):
    """FMPy is asked about names that are not plainly right; all together it says the same."""
    path = tmp_path / "named.fmu"
    retouched(tiny / "ramp.fmu", path, lambda text: text.replace('name="slope"', f'name="{name}"'))
    assert main(["validate", str(path), "--stop-time", "1"]) == 0
    said = "".join(capsys.readouterr().out.split())
    expected = validate_fmu(str(path))
    assert ("naming convention" in "".join(expected)) == (name in ("slo pe", "1slope", "a[x]", "a..b", "a[1][2]"))
    assert all("".join(rule.split()) in said for rule in expected)
    assert ("modelDescription.xml" in said) == bool(expected)


CAMPAIGN = """
system = "{}"
trials = 2
seed = 1
[draw."ramp.{}"]
distribution = "uniform"
low = 1.0
high = 2.0
[metric.end]
expression = "ramp.y"
reduction = "final"
[success]
expression = "end > 0"
"""


@pytest.mark.parametrize(
    ("name", "parameter", "problem"),
    [
        ("s", "slope", None),
        ("other", "slope", "system: the campaign is for other, not s; simulate other"),
        ("s", "gone", "no such parameter in the system"),
    ],
)
def test_a_campaign_is_refused_as_by_batch(tiny_folder, tmp_path, capsys, name, parameter, problem):
    """In the system's folder, and by itself with the system in the same command."""
    folder = tmp_path / "s"
    (folder / "resources").mkdir(parents=True)
    (folder / "campaigns").mkdir()
    (folder / "resources" / "ramp.fmu").write_bytes((tiny_folder / "native" / "ramp.fmu").read_bytes())
    (folder / "SystemStructure.ssd").write_text(document(system(component("ramp", "ramp", "output y Real m"))))
    for path in (folder / "campaigns" / "c.toml", tmp_path / "c.toml"):
        path.write_text(CAMPAIGN.format(name, parameter))
        paths = [str(path)] if path.parent != tmp_path else [str(folder), str(path)]
        assert main(["validate", *paths]) == (0 if problem is None else 2)
        said = capsys.readouterr().err
        if problem is not None:
            assert problem in said
            assert main(["batch", str(folder), "--campaign", str(path)]) == 2
            assert said == capsys.readouterr().err


def test_a_campaign_without_its_system_is_noted(tmp_path, capsys):
    (tmp_path / "c.toml").write_text(CAMPAIGN.format("other", "slope"))
    assert main(["validate", str(tmp_path / "c.toml")]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert (
        "checked without its system other, which Perilune does not contain: name the system in the same command" in said
    )


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("system", ["", 'system = "lunar_terminal_guidance"\n'])
def test_a_campaign_that_extends_a_shipped_one_is_taken_as_by_batch(tmp_path, capsys, monkeypatch, system):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(f'{system}extends = "paper"\ntrials = 2\n')
    assert main(["batch", "lunar_terminal_guidance", "--campaign", "./mine.toml", "--workers", "1"]) == 0
    capsys.readouterr()
    assert main(["validate", "mine.toml"]) == 0
    assert capsys.readouterr().out == "mine.toml: OK\n"
    (tmp_path / "wrong.toml").write_text(f'{system}extends = "papr"\n')
    assert main(["validate", "wrong.toml"]) == 2


def test_messages_name_no_folder_of_archives(capsys):
    assert main(["batch", "lunar_terminal_guidance", "--campaign", "paper", "--configuration", "none"]) == 2
    error = capsys.readouterr().err
    assert "campaigns/paper.toml" in error
    assert "org.perilune" not in error
