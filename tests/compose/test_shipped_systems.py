"""Every shipped system as a system.toml and back: the same SSD, and the same flight bit by bit.

Truth: the shipped SSD in canonical XML, connectors, connections and units sorted here; its own flight.
"""

from __future__ import annotations

import shutil

import pytest
from lxml import etree

import perilune
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.fmus_src.paths import SYSTEMS
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
SSD = "SystemStructure.ssd"
SORTED = ("Connectors", "Connections", "Units")


def canonical(path):
    """Canonical XML without comments and space between elements, children of SORTED in order of their text."""
    root = etree.parse(path, etree.XMLParser(remove_blank_text=True, remove_comments=True)).getroot()
    for element in root.iter():
        if etree.QName(element).localname in SORTED:
            element[:] = sorted(element, key=lambda each: etree.tostring(each, method="c14n"))
    return etree.tostring(root, method="c14n")


NAMES = either(system_names(), ["lunar_descent_2d", "lunar_terminal_guidance"])


@pytest.mark.parametrize("name", NAMES)
def test_its_short_file_states_its_ssd(name):
    (check,) = perilune.validate(SYSTEMS / name / "system.toml")
    assert (check.problems, check.notes) == ((), ())
    assert perilune.compose(name).toml == (SYSTEMS / name / "system.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", NAMES)
def test_there_and_back(tmp_path, name):
    shutil.copytree(
        SYSTEMS / name, tmp_path / name, ignore=shutil.ignore_patterns(SSD, "system.toml", "annotations.xml")
    )
    toml = tmp_path / name / "system.toml"
    back = perilune.compose(name, output=toml)
    assert back.paths[0] == toml
    assert perilune.compose(toml).paths == (tmp_path / name / SSD,)
    shipped, composed = (folder / name / SSD for folder in (SYSTEMS, tmp_path))
    assert canonical(composed) == canonical(shipped)
    annotations = (tmp_path / name / "annotations.xml").read_bytes()
    assert annotations in shipped.read_bytes()
    assert annotations in composed.read_bytes()
    assert sorted(perilune.compose(tmp_path / name).toml.split()) == sorted(back.toml.split())
    flights = [perilune.simulate(folder / name) for folder in (SYSTEMS, tmp_path)]
    assert flights[0].status == flights[1].status
    assert set(flights[0].signals) == set(flights[1].signals)
    for signal, values in flights[0].signals.items():
        assert values.tobytes() == flights[1][signal].tobytes(), signal
