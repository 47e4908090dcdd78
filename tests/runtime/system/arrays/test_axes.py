"""Names of axes declared in an SSD: elements with named axes, refusals, and unchanged simulations.

Truth: the declaration as written, the table of frames in the conventions, the frames declared by blocks, and the line
number of a wrong element.
"""

from __future__ import annotations

import re
import shutil

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import ROOT, SYSTEMS
from perilune.fmus_src.catalogue import catalogue
from tests.support.pages.declaring import shipped_ssd, with_frames

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "landing_mission"
SITE = '<Frame name="landing site" axes="north west up"/>'


@pytest.fixture(scope="module")
def loaded():
    """Return the FMUs of the system, loaded once."""
    return {}


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(SYSTEMS / NAME, tmp_path / NAME)
    return tmp_path / NAME


def declare(folder, inside):
    text = with_frames(shipped_ssd(folder.name), inside)
    (folder / "SystemStructure.ssd").write_text(text, encoding="utf-8")
    return text


def axes_of(folder, loaded, inside, **options):
    declare(folder, inside)
    return prepare_system(folder, SystemOptions(**options), loaded).network.axes


def test_the_vectors_of_a_frame_are_those_that_blocks_declare_in_it(folder, loaded):
    axes = axes_of(folder, loaded, SITE)
    blocks = catalogue()
    for component, fmu in prepare_system(folder, SystemOptions(), loaded).network.fmus.items():
        for variable in blocks[fmu.name].variables.values():
            if variable.record is not None or not variable.is_array:
                continue
            names = [f"{component}.{name}" for name in variable.element_names()]
            inside = variable.frame == "landing site" and len(names) == 3
            assert [axes.get(name) for name in names] == (["north", "west", "up"] if inside else [None] * len(names))
    assert axes["plant.position[3]"] == "up"


def test_what_is_listed_goes_before_what_is_described(folder, loaded):
    axes = axes_of(
        folder,
        loaded,
        '<Frame name="landing site" axes="north west up" signals="divert_position"/>\n<!-- a comment -->\n'
        '<Frame name="ground" axes="along across" signals="sequencer.redesignation_1"/>\n'
        '<Vector signals="plant.velocity" elements="a b c"/>',
    )
    assert [axes[f"divert_position[{index}]"] for index in (1, 2, 3)] == ["north", "west", "up"]
    assert [axes[f"sequencer.redesignation_1[{index}]"] for index in (1, 2)] == ["along", "across"]
    assert [axes[f"plant.velocity[{index}]"] for index in (1, 2, 3)] == ["a", "b", "c"]
    assert "sequencer.redesignation_2[1]" not in axes  # of two elements: which axes they are along nothing says


def test_shipped_names_are_those_of_the_conventions():
    table = (ROOT / "docs" / "concepts" / "conventions.md").read_text(encoding="utf-8")
    (row,) = re.findall(r"^\| `landing site` \| (.*) \|$", table, flags=re.MULTILINE)
    for name in ("landing_mission", "hover_transfer", "lunar_landing", "lunar_terminal_guidance"):
        frames = prepare_system(name).network.frames
        assert ", ".join(map(" ".join, zip("xyz", frames["landing site"], strict=True))) in row


def test_the_docs_have_the_annotation_of_a_system():
    page = (ROOT / "docs" / "reports.md").read_text(encoding="utf-8")
    (snippet,) = re.findall(r"```xml\n( *<ssc:Annotation type=\"org.perilune.frames\">\n.*?)```", page, flags=re.DOTALL)
    assert snippet in shipped_ssd("orbital_attitude")


def test_a_flight_has_the_same_bits_and_says_the_names(loaded, tmp_path):
    folder = tmp_path / "lunar_terminal_guidance"
    shutil.copytree(SYSTEMS / folder.name, folder)
    flights = []
    for inside in (SITE, "", '<Vector signals="plant.position" elements="a b c"/>'):
        declare(folder, inside)
        with Simulation(prepare_system(folder, SystemOptions(), loaded)) as simulation:
            flight = simulation.fly()
            flights.append((np.stack(list(flight.signals.values())).tobytes(), flight.provenance))
    assert len({numbers for numbers, _ in flights}) == 1
    first, second, third = (provenance.get("axes") for _, provenance in flights)
    assert first is not None
    assert first["plant.position[3]"] == "up"
    assert second is None
    assert third == {"plant.position[1]": "a", "plant.position[2]": "b", "plant.position[3]": "c"}


FRAME = [
    (
        'name="landing sight" axes="a b c"',
        "frame landing sight: no variable's description names it; use one of landing",
    ),
    ('name="landing site"', 'no axes; write axes="..."'),
    ('axes="a b c"', 'no name; write name="..."'),
    ('name="landing site" axes="a b"', "axes has 2 names, .* has 3 elements; write one name for each"),
    ('name="landing site" axes="a b c d"', "axes has 4 names; write two or three names, one for each axis"),
    ('name="landing site" axes="a b b"', "axes: b occurs twice; give each axis a different name"),
    ('name="landing site" axes="a b c" frame="x"', "unknown attribute frame"),
    ('name="other" axes="a b c" signals="plant.positoin"', "signals plant.positoin: no such vector; .*plant.position"),
    ('name="other" axes="a b c" signals="plant.mass"', "signals plant.mass: no such vector"),
]
VECTOR = [
    (
        'signals="plant.position" elements="a b"',
        "elements has 2 names, but plant.position has 3 elements; write one name for each",
    ),
    ('signals="plant.mass plant.mass" elements="a"', "signals plant.mass: no such vector"),
    ('signals="plant.position plant.position" elements="a b c"', "signals plant.position is listed twice"),
    ('signals="plant.position"', 'no elements; write elements="..."'),
]


@pytest.mark.parametrize(
    ("inside", "line"),
    [
        *((f"<Frame {attributes}/>", line) for attributes, line in FRAME),
        *((f"<Vector {attributes}/>", line) for attributes, line in VECTOR),
        (f"{SITE}{SITE}", "a second Frame landing site; write only one"),
        ('<Axes name="landing site"/>', "unknown element; use one of Frame, Vector"),
    ],
)
def test_a_wrong_declaration_is_refused_with_its_line(folder, loaded, inside, line):
    text = declare(folder, inside)
    number = text.count("\n", 0, text.index(inside)) + 1
    with pytest.raises(InputError, match=rf"SystemStructure\.ssd: \w+ \(line {number}\): {line}"):
        prepare_system(folder, SystemOptions(), loaded)


def test_it_ends_in_one_line_and_status_2(folder, capsys):
    declare(folder, '<Frame name="landing sight" axes="a b c"/>')
    assert main(["validate", str(folder)]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert re.fullmatch(r"perilune: .*SystemStructure\.ssd: Frame \(line \d+\): frame landing sight.*\n", captured.err)


def test_a_component_that_is_put_in_may_lack_its_vectors(folder, loaded):
    inside = f'{SITE}<Vector signals="plant.position guidance.gain" elements="a b c"/>'
    use = {"guidance": "apollo_guidance"}
    assert axes_of(folder, loaded, inside, use=use)["plant.position[1]"] == "a"
