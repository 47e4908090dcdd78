"""`perilune design law`: formula, parameter set, drawing, JSON, exit status.

Truth: the same simulation with the parameter set and with the published law of the system; the SSP schema; errors in
one line on standard error, exit status 2, and no remaining file.
"""

import json

import pytest
from lxml import etree

import perilune
from perilune.analysis.cli import main
from perilune.analysis.design.laws.law import find_law
from perilune.analysis.runtime.ssp.parameter_sets import read_parameter_file

pytestmark = pytest.mark.usefixtures("fmus")


def test_prints_the_formula(capsys):
    assert main(["design", "law", "diveev_2013"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1:3] == ["formula", "z1 = pi + theta"]
    assert "u2 = z16 = -z12 + exp(z13) + cbrt(z15)" in lines
    assert lines[-1] == "q1 = 1.50049, q2 = 13.5459, q3 = 12.96753; exp saturates legacy"


def test_the_parameter_set_is_the_law(tmp_path, capsys):
    """diveev_2013 is what lunar_descent_2d flies by itself; the basic solution falls to the ground."""
    for name in ("diveev_2013", "diveev_2013_basic"):
        path = tmp_path / "new" / f"{name}.ssv"
        assert main(["design", "law", name, "--output", str(path)]) == 0
        law = json.loads(find_law(name).read_text())
        values = {entry.name: entry.value for entry in read_parameter_file(path.read_bytes(), str(path))}
        assert len(values) == 256 + 3 + 1
        for row in range(16):
            for column in range(16):
                assert values[f"guidance.matrix[{row + 1},{column + 1}]"] == law["matrix"][row][column]
        assert [values[f"guidance.q[{place}]"] for place in (1, 2, 3)] == law["q"]
        assert values["guidance.exp_saturation"] == 1
    assert main(["validate", str(path)]) == 0
    options = {"step": 0.05, "set": {"sensor.sample_period": 0.05}}
    own = perilune.simulate("lunar_descent_2d", **options)
    settings = perilune.simulate("lunar_descent_2d", parameters=[str(tmp_path / "new" / "diveev_2013.ssv")], **options)
    assert settings.status == own.status == "finished"
    for name, values in own.signals.items():
        assert (settings.signals[name] == values).all(), name
    basic = perilune.simulate("lunar_descent_2d", parameters=[str(path)], **options)
    assert basic.final()["plant.ground_contact"]
    capsys.readouterr()


def test_another_component_and_the_true_exponential(tmp_path):
    law = json.loads(find_law("diveev_2013").read_text()) | {"exp_saturation": "true"}
    (tmp_path / "mine.json").write_text(json.dumps(law))
    path = tmp_path / "mine.ssv"
    assert (
        main(["design", "law", str(tmp_path / "mine.json"), "--output", str(path), "--component", "lander.guidance"])
        == 0
    )
    values = {entry.name: entry.value for entry in read_parameter_file(path.read_bytes(), str(path))}
    assert values["lander.guidance.exp_saturation"] == 0
    assert all(name.startswith("lander.guidance.") for name in values)


def test_draws_the_graph(tmp_path):
    path = tmp_path / "new" / "law.svg"
    assert main(["design", "law", "diveev_2013", "--graph", str(path)]) == 0
    assert etree.parse(path).getroot().tag == "{http://www.w3.org/2000/svg}svg"
    assert [entry.name for entry in path.parent.iterdir()] == ["law.svg"]


def test_json(tmp_path, capsys):
    assert main(["design", "law", "diveev_2013_basic", "--json", "-"]) == 0
    actual = json.loads(capsys.readouterr().out)
    assert actual.pop("formula") == {
        "z3": "(hf - h)/h0",
        "z15": "(pi + theta)*q1 + step(z3)*z3*q2",
        "z16": "-cos(theta)*theta*q3",
    }
    assert actual == json.loads(find_law("diveev_2013_basic").read_text())
    assert main(["design", "law", "diveev_2013_basic", "--json", str(tmp_path / "law.json")]) == 0
    assert "u1 = z15" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["none"], "law: no such law or file; use one of diveev_2013, diveev_2013_basic"),
        (["diveev_2013", "--output", "law.txt"], "--output: law.txt: not .ssv"),
        (["diveev_2013", "--graph", "law.png"], "--graph: law.png: not .svg"),
        (["diveev_2013", "--component", "plant"], "--component: plant: has no effect unless --output is given"),
        (["diveev_2013", "--output", "law.ssv", "--component", ""], "--component: '': not a valid component name"),
        (["diveev_2013", "--output", "law.ssv", "--component", "a\x01"], "not a valid component name"),
        (["bad.json", "--output", "law.ssv", "--graph", "law.svg"], "bad.json: matrix[8,3]: 5 is below the diagonal"),
    ],
)
def test_wrong_input(tmp_path, monkeypatch, capsys, arguments, words):
    monkeypatch.chdir(tmp_path)
    law = json.loads(find_law("diveev_2013").read_text())
    law["matrix"][7][2] = 5
    (tmp_path / "bad.json").write_text(json.dumps(law))
    assert main(["design", "law", *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("perilune: ")
    assert words in error
    assert error.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["bad.json"]
