"""`perilune describe SYSTEM --campaign NAME`: the resolved campaign, each value with its file and line.

Truth: the printed assignments are TOML of the same campaign; the named lines are read here.
"""

import json
import tomllib
from pathlib import Path

import pytest

import perilune
from perilune.analysis.authoring.campaign_listing import toml_value
from perilune.analysis.campaigns.definition.file import parse_campaign, read_campaign
from perilune.analysis.campaigns.definition.table import TomlTable
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS

CAMPAIGNS = sorted(path for path in SYSTEMS.glob("*/campaigns/*.toml"))
SHIPPED = [(path.parts[-3], path) for path in CAMPAIGNS if "network_operator]" not in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize(("system", "path"), SHIPPED, ids=[f"{system}-{path.stem}" for system, path in SHIPPED])
def test_the_printed_values_are_the_campaign(system, path):
    """As TOML without ``extends`` they give an equal campaign, and each stands in the line that is named."""
    described = perilune.describe(system, campaign=path.stem)
    text = "\n".join(f"{each['name']} = {toml_value(each['value'])}" for each in described["values"])
    resolved = parse_campaign(TomlTable(tomllib.loads(text), str(path)))
    expected = read_campaign(path)
    assert repr(resolved).replace(str(path), "") == repr(expected).replace(str(path), "")
    for each in described["values"]:
        line = (SYSTEMS / system / each["file"]).read_text(encoding="utf-8").splitlines()[each["line"] - 1]
        assert any(part.strip('"') in line for part in [each["name"], each["name"].rpartition(".")[2]]), each


def test_what_extends_replaces_a_value(tmp_path):
    (tmp_path / "earlier.toml").write_text('trials = 10\n[set]\n"plant.gravity" = 1.6\n[success]\nexpression = "1"\n')
    text = 'extends = "earlier.toml"\nsystem = "lunar_landing"\nseed = 1\n\n[set]\n"plant.gravity" = 1.7\n'
    (tmp_path / "later.toml").write_text(text)
    described = perilune.describe("lunar_landing", campaign=str(tmp_path / "later.toml"))
    origins = {each["name"]: (each["value"], Path(each["file"]).name, each["line"]) for each in described["values"]}
    assert origins["trials"] == (10, "earlier.toml", 1)
    assert origins['set."plant.gravity"'] == (1.7, "later.toml", 6)


def test_the_command_line(capsys):
    assert main(["describe", "entry_attitude", "--campaign", "cases"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(len(line) <= 100 for line in lines)
    first, inherited = lines.index("campaigns/cases.toml"), lines.index("campaigns/parts/cases.toml")
    assert ["7", "seed", "=", "3200"] in [line.split() for line in lines[first:]]
    assert lines[inherited + 1].split() == ["4", "draw.case.distribution", "=", '"grid"']
    assert main(["describe", "entry_attitude", "--campaign", "cases", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["variants"][0] == "robust_control"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["lunar_landing", "--campaign", "nowhere"], "nowhere"),
        (["lunar_landing", "plant", "--campaign", "terminal_box"], "together with a component or other options"),
        (
            ["lunar_landing", "--campaign", "terminal_box", "--step", "0.1"],
            "together with a component or other options",
        ),
    ],
)
def test_refusals(arguments, message, refusal):
    assert message in refusal(["describe", *arguments])
