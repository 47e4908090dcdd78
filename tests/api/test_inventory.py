"""perilune.inventory and `perilune list`: restriction to one kind, and search for a text.

Truth: the files of the checkout, and the complete list, which contains every restricted list.
"""

from __future__ import annotations

import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.verbs.inventory import KINDS
from perilune.common.paths import LAWS, SYSTEMS

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture(scope="module")
def everything(fmus):
    return perilune.inventory()


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "campaigns"])
def test_a_kind_alone(everything, kind):
    listed = perilune.inventory(kind)
    for each in ("systems", "laws", "searches", "fmus"):
        assert getattr(listed, each) == (getattr(everything, each) if each == kind else type(getattr(listed, each))())


def test_campaigns_of_each_system(capsys):
    assert main(["list", "campaigns"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith(" " * 18)]
    folders = sorted(path.parent.name for path in SYSTEMS.glob("*/campaigns"))
    assert lines[::2] == folders
    assert all(line.startswith("  campaigns ") for line in lines[1::2])


def test_a_text_in_names_and_descriptions_in_capitals_or_not(everything):
    listed = perilune.inventory("KALMAN")
    assert {name for name in everything.fmus if "kalman" in name} <= set(listed.fmus)
    for name, fmu in everything.fmus.items():
        assert (name in listed.fmus) == ("kalman" in f"{name} {fmu.description}".lower())
    assert set(perilune.inventory("rendezvous").systems) == {"robot_rendezvous"}
    assert "satellite_pointing" in perilune.inventory("agile").systems  # a campaign of it


def test_a_law_by_its_name():
    name = next(LAWS.glob("*.json")).stem
    assert name in perilune.inventory(name).laws


def test_a_text_that_nothing_has(refusal):
    expected = "list: no_such_text: no name or description contains this word; give another text, or a kind: "
    assert expected in refusal(["list", "no_such_text"])


def test_the_whole_list_has_no_description_of_systems(everything, capsys):
    """Give the list of names as JSON has it."""
    assert main(["list"]) == 0
    assert everything.systems["lunar_landing"].description
    assert everything.systems["lunar_landing"].description not in " ".join(capsys.readouterr().out.split())
