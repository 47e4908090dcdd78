"""Shipped systems: reproducible composition, reconstruction of system.toml, and equal simulations.

Truth: the hand-written system.toml and annotations.xml; the schema of SSP; numbers of vector pairs counted in the text.
"""

from __future__ import annotations

import re
import shutil
import tomllib

import pytest
from lxml import etree

import perilune
from perilune.analysis import shipped
from perilune.analysis.cli import main
from perilune.analysis.compose.likeness import find_difference
from perilune.analysis.runtime.ssp.archive import system_names
from perilune.analysis.runtime.ssp.documents import check_schema
from perilune.common.paths import BUILD, SYSTEMS
from tests.support.lengths import either

pytestmark = pytest.mark.usefixtures("fmus")
SSD, TOML, NOTES = "SystemStructure.ssd", "system.toml", "annotations.xml"
NAMES = either(system_names(), ["lunar_terminal_guidance"])
INDEX = re.compile(r"\[[\d,]+\]$")


@pytest.fixture
def copied(tmp_path):
    """Return a function that copies a shipped system to a folder, without the named files."""

    def copy(name, *without):
        folder = tmp_path / name
        shutil.copytree(SYSTEMS / name, folder, ignore=shutil.ignore_patterns(*without))
        return folder

    return copy


@pytest.mark.parametrize("name", NAMES)
def test_composed_once_more_it_has_the_same_bytes(copied, name):
    """In another folder, whatever the flavour of the FMUs that it takes types and units of."""
    folder = copied(name, SSD)
    built = (SYSTEMS / name / SSD).read_bytes()
    check_schema(etree.fromstring(built), "ssd", SSD)
    assert perilune.compose(folder / TOML).paths == (folder / SSD,)
    assert (folder / SSD).read_bytes() == built
    (folder / SSD).unlink()
    assert shipped.compose_shipped(folder / TOML, [BUILD / "fmus" / "python"]).read_bytes() == built


@pytest.mark.parametrize("name", system_names())
def test_all_that_a_person_wrote_is_in_it(name):
    """All connections of the system.toml, no others, and the annotations byte for byte; the way back is that file."""
    root = etree.parse(SYSTEMS / name / SSD).getroot()
    pairs = {
        tuple(
            ".".join(filter(None, (each.get(f"{end}Element"), INDEX.sub("", each.get(f"{end}Connector")))))
            for end in ("start", "end")
        )
        for each in root.iter("{*}Connection")
    }
    stated = tomllib.loads((SYSTEMS / name / TOML).read_text(encoding="utf-8"))
    texts = [*stated["connections"], *stated.get("system", {}).get("connections", ())]
    written = {
        (INDEX.sub("", source.strip()), INDEX.sub("", target.strip()))
        for source, _, targets in (text.partition("->") for text in texts)
        for target in re.split(r",(?![^\[]*\])", targets)
    }
    assert pairs == written
    assert {each.get("name") for each in root.iter("{*}Component")} == set(stated["components"])
    assert (SYSTEMS / name / NOTES).read_bytes() in (SYSTEMS / name / SSD).read_bytes()
    assert perilune.compose(name).toml == (SYSTEMS / name / TOML).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", NAMES)
def test_there_and_back(copied, name):
    toml = copied(name, SSD, TOML, NOTES) / TOML
    back = perilune.compose(name, output=toml)
    assert back.paths[:2] == (toml, toml.with_name(NOTES))  # and its parameter sets, which are there
    perilune.compose(toml)
    built, rebuilt = (folder / name / SSD for folder in (SYSTEMS, toml.parents[1]))
    assert find_difference(built.read_bytes(), rebuilt.read_bytes()) is None
    flights = [perilune.simulate(path.parent) for path in (built, rebuilt)]
    assert flights[0].status == flights[1].status
    assert set(flights[0].signals) == set(flights[1].signals)
    for signal, values in flights[0].signals.items():
        assert values.tobytes() == flights[1][signal].tobytes(), signal


@pytest.mark.parametrize("name", either(system_names(), ["earth_pointing", "orbital_attitude"]))
def test_in_another_folder_are_the_sets_that_its_annotations_name(name, tmp_path):
    toml = tmp_path / name / TOML
    perilune.compose(name, output=toml)
    sets = set(re.findall(r'<ParameterSet source="([^"]+)"', (SYSTEMS / name / NOTES).read_text(encoding="utf-8")))
    for each in sets:
        assert toml.with_name(each).read_bytes() == (SYSTEMS / name / each).read_bytes()
    if name == "earth_pointing":
        assert sets == {"ideal.ssv"}
        perilune.compose(toml)
        assert main(["validate", str(toml.parent)]) == 0


def test_what_changed_since_is_reported(copied, monkeypatch, capsys):
    """One line on standard error, with the command that mends it, for the system.toml and for its annotations; a note
    of validate."""
    name = "lunar_descent_2d"
    folder = copied(name)
    monkeypatch.chdir(folder.parent)
    problem = f"this file or its annotations have changed since {SSD} was composed from it"
    line = f"{name}/{TOML}: {problem}; perilune compose {name}/{TOML}\n"
    for file, before, after in ((TOML, 'name = "', '# mine\nname = "'), (NOTES, "</Report>", "<!-- mine --></Report>")):
        assert main(["run", f"./{name}", "--stop-time", "1"]) in (0, 1)
        assert line not in capsys.readouterr().err
        text = (folder / file).read_text(encoding="utf-8")
        assert before in text
        (folder / file).write_text(text.replace(before, after), encoding="utf-8")
        assert main(["run", f"./{name}", "--stop-time", "1"]) in (0, 1)
        assert f"perilune: {line}" in capsys.readouterr().err
        (check,) = perilune.validate(f"./{name}")
        assert line.strip() in check.notes
        assert main(["compose", f"{name}/{TOML}"]) == 0


def test_one_that_is_not_built_says_how(copied, monkeypatch, capsys):
    folder = copied("lunar_descent_2d", SSD)
    monkeypatch.setattr("perilune.analysis.runtime.ssp.archive.SYSTEMS", folder.parent)
    assert main(["run", "lunar_descent_2d"]) == 2
    assert capsys.readouterr().err.endswith(f"lunar_descent_2d: {SSD}: not found; run make build\n")
    monkeypatch.undo()
    monkeypatch.chdir(folder.parent)
    assert main(["run", "./lunar_descent_2d"]) == 2
    assert capsys.readouterr().err.endswith(f"perilune compose {folder}/{TOML} writes it\n")


def test_an_edited_one_is_not_written_over(copied):
    ssd = copied("lunar_descent_2d") / SSD
    ssd.write_text(ssd.read_text(encoding="utf-8").replace('startTime="0"', 'startTime="1"'), encoding="utf-8")
    with pytest.raises(perilune.InputError, match="was edited since perilune compose wrote it"):
        shipped.compose_shipped(ssd.with_name(TOML), [BUILD / "fmus" / "python"])
