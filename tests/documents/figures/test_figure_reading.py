"""Declared figures of a system, and errors in declarations, each in one line that names the place.

Truth: the declaration as written, the number of the line on which its wrong element begins, and the factors of units.
"""

import math
import re
import shutil
from dataclasses import replace

import pytest

from perilune.analysis.cli import main
from perilune.analysis.documents.figures.declared import (
    BandFigure,
    ErrorFigure,
    GroupDeclaration,
    PulsesFigure,
    UnavailableFigure,
)
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.flight.program import make_layout
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import BUILD, SYSTEMS
from perilune.fmus_src.export.ssp_package import pack_system
from tests.support.builders import component, connection, document, pack, system
from tests.support.pages.declaring import shipped_ssd, with_report

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "orbital_attitude"
BAND = '<Band signal="plant.angles" low="-1" high="1" unit="deg"/>'
DEGREE = math.pi / 180.0


@pytest.fixture(scope="module")
def loaded():
    """Return the FMUs of the system, loaded once."""
    return {}


@pytest.fixture
def tiny(tiny_folder):
    """Return the tiny FMUs, of which the declarations alone count here."""
    return tiny_folder / "native"


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(SYSTEMS / NAME, tmp_path / NAME)
    return tmp_path / NAME


def declare(folder, inside):
    text = with_report(shipped_ssd(NAME), inside)
    (folder / "SystemStructure.ssd").write_text(text, encoding="utf-8")
    return text


def read(folder, loaded, inside):
    text = declare(folder, inside)
    return text, read_figures(prepare_system(folder, SystemOptions(), loaded))


def test_nothing_is_asked_for(folder, loaded):
    requested = re.compile(r'<ssc:Annotation type="org.perilune.report">.*?</ssc:Annotation>', re.DOTALL)
    (folder / "SystemStructure.ssd").write_text(requested.sub("", shipped_ssd(NAME)), encoding="utf-8")
    assert read_figures(prepare_system(folder, SystemOptions(), loaded)) == []


def test_all_that_can_be_asked_for(folder, loaded):
    _, (angles, rates, pulses, error) = read(
        folder,
        loaded,
        '<Band signal="plant.angles" low="-0.5" high="0.5" unit="deg" name="settled" labels=" roll yaw  pitch"/>\n'
        "<!-- a comment -->\n"
        '<Band title="Rates" signal="plant.angular_velocity" about="0 0 -0.0011" high="5e-2"/>\n'
        '<Pulses lengths="pulses.pulse_lengths" count="pulses.pulse_count" remainder="pulses.remainder"\n'
        ' total="plant.jet_seconds" labels="x y z"/>\n'
        '<Error estimate="observer.estimated_angles[2]" truth="plant.angles[2]" sigma="observer.yaw_sigma"'
        ' after="60"/>',
    )
    assert isinstance(angles, BandFigure)
    assert (angles.title, angles.name, angles.labels) == ("plant.angles", "settled", ("roll", "yaw", "pitch"))
    assert angles.signal.names == ("plant.angles[1]", "plant.angles[2]", "plant.angles[3]")
    assert angles.signal.factor == pytest.approx(1.0 / DEGREE, rel=1e-15)
    assert (angles.low, angles.high, angles.signal.unit_name, angles.about) == (-0.5, 0.5, "deg", ())
    assert isinstance(rates, BandFigure)
    assert (rates.title, rates.name, rates.labels) == ("Rates", "within the band", ("[1]", "[2]", "[3]"))
    assert (rates.low, rates.high, rates.signal.unit_name) == (None, 0.05, "rad/s")
    assert rates.about == (0.0, 0.0, -0.0011)
    assert rates.signal.offsets == (0.0, 0.0, 0.0011)
    assert isinstance(pulses, PulsesFigure)
    assert pulses.count.names == ("pulses.pulse_count",)
    assert (len(pulses.remainder.names), pulses.total.label, pulses.labels) == (3, "plant.jet_seconds", ("x", "y", "z"))
    assert isinstance(error, ErrorFigure)
    assert error.title == "observer.estimated_angles[2] less plant.angles[2]"
    assert (error.sigma.names, error.after, error.labels) == (("observer.yaw_sigma",), 60.0, ("",))
    assert not any(figure.notes for figure in (angles, rates, pulses, error))


WRONG = {
    # the wrong element, which element the message names, words of it
    "unknown element": ("<Bnad/>", "Bnad", "unknown element; the nearest of 10 known names: Band"),
    "group without title": ("<Group><Band/></Group>", "Group", "no title"),
    "empty group": ('<Group title="x"/>', "Group", "no figure"),
    "fold that is no truth": ('<Group title="x" folded="yes"/>', "Group", "folded 'yes' is neither true nor false"),
    "unknown attribute": ('<Band signal="plant.angles" hi="1"/>', "Band", "unknown attribute hi"),
    "no signal": ('<Band low="1"/>', "Band", "no signal"),
    "no limit": ('<Band signal="plant.angles"/>', "Band", "neither low nor high"),
    "limits swapped": ('<Band signal="plant.angles" low="1" high="-1"/>', "Band", "low = 1 is not below high = -1"),
    "limit that is no number": ('<Band signal="plant.angles" low="1 deg"/>', "Band", "low '1 deg' is not a number"),
    "unknown signal": ('<Band signal="plant.angels" low="0"/>', "Band", "signal plant.angels: no such signal; the"),
    "element beyond a vector": ('<Band signal="plant.angles[4]" low="0"/>', "Band", "plant.angles[4]: no such signal"),
    "unconnected input": ('<Band signal="plant.orbital_rate" low="0"/>', "Band", "plant.orbital_rate: no such signal"),
    "shade without a value": (
        '<Band signal="plant.angles" low="0" shade="plant.jet_seconds"/>',
        "Band",
        "shade and shade_below belong together",
    ),
    "against a vector": (
        '<Band signal="plant.angles" low="0" against="plant.angles"/>',
        "Band",
        "against plant.angles: no such scalar",
    ),
    "less of another size": (
        '<Band signal="plant.angles" low="0" less="plant.angles[1]"/>',
        "Band",
        "less plant.angles[1] has 1 elements",
    ),
    "unknown unit": ('<Band signal="plant.angles" low="0" unit="grad"/>', "Band", "unit grad is not defined"),
    "unit that does not fit": (
        '<Band signal="plant.angles" low="0" unit="s"/>', "Band", "signal plant.angles: its unit is rad, but s"
    ),
    "unit of what has none": (
        '<Band signal="plant.status" low="0" unit="s"/>', "Band", "plant.status: its unit is none, but s is required"
    ),
    "about of another size": (
        '<Band signal="plant.angles" low="0" about="1 2"/>', "Band", "about has 2 numbers, plant.angles has 3 elements"
    ),
    "about that is no number": ('<Band signal="plant.angles" low="0" about="1 2 x"/>', "Band", "about 'x' is not a"),
    "labels of another number": (
        '<Band signal="plant.angles" low="0" labels="a b"/>', "Band", "labels has 2 names, plant.angles has 3 elements"
    ),
    "pulses without lengths": ("<Pulses/>", "Pulses", "no lengths"),
    "pulses that are no times": (
        '<Pulses lengths="plant.angles"/>', "Pulses", "lengths plant.angles: its unit is rad, but s"
    ),
    "count that is Real": (
        '<Pulses lengths="pulses.pulse_lengths" count="plant.jet_seconds"/>', "Pulses",
        "count plant.jet_seconds is not Integer",
    ),
    "remainder of another size": (
        '<Pulses lengths="pulses.pulse_lengths" remainder="pulses.remainder[1]"/>', "Pulses",
        "remainder pulses.remainder[1] has 1 elements, pulses.pulse_lengths has 3 elements",
    ),
    "total that is a vector": (
        '<Pulses lengths="pulses.pulse_lengths" total="pulses.remainder"/>', "Pulses",
        "total pulses.remainder is a vector",
    ),
    "error without a truth": ('<Error estimate="observer.yaw_sigma"/>', "Error", "no truth"),
    "truth of another size": (
        '<Error estimate="observer.estimated_angles" truth="plant.angles[2]"/>', "Error",
        "truth plant.angles[2] has 1 elements, observer.estimated_angles has 3 elements",
    ),
    "truth of another unit": (
        '<Error estimate="observer.estimated_angles" truth="plant.angular_velocity"/>', "Error",
        "truth plant.angular_velocity: its unit is rad/s, but rad is required",
    ),
    "sigma of another unit": (
        '<Error estimate="plant.angles[2]" truth="plant.angles[2]" sigma="plant.jet_seconds"/>', "Error",
        "sigma plant.jet_seconds: its unit is s, but rad is required",
    ),
    "time that is no number": (
        '<Error estimate="plant.angles" truth="plant.angles" after="soon"/>', "Error", "after 'soon' is not a number"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_everything_wrong_is_refused_with_its_line(folder, loaded, name):
    bad, element, words = WRONG[name]
    with pytest.raises(InputError) as caught:
        read(folder, loaded, f"{BAND}\n{bad}")
    text = (folder / "SystemStructure.ssd").read_text(encoding="utf-8")
    line = text[: text.index(bad)].count("\n") + 1
    message = str(caught.value)
    assert message.startswith(f"{folder}/SystemStructure.ssd: {element} (line {line}): ")
    assert words in message
    assert "\n" not in message


@pytest.mark.parametrize("inside", ["<Limits/>", "<Scene/>", "<Group/>", "<Bnad/>"])
def test_a_group_has_figures_alone(folder, loaded, inside):
    """Limits and scenes have sections by themselves."""
    with pytest.raises(InputError, match=r"line \d+\): unknown element"):
        read(folder, loaded, f'<Group title="x">{inside}</Group>')


def test_figures_have_the_group_that_they_are_in(folder, loaded):
    inside = f'{BAND}<Group title=" Errors " folded="true">{BAND}{BAND}</Group><Group title="x">{BAND}</Group>{BAND}'
    _, figures = read(folder, loaded, inside)
    errors, open_one = GroupDeclaration("Errors", is_folded=True), GroupDeclaration("x", is_folded=False)
    assert [figure.group for figure in figures] == [None, errors, errors, open_one, None]
    assert {replace(figure, group=None) for figure in figures} == {figures[0]}


@pytest.mark.parametrize("inside", ["", "<Reprot/>", '<Report xmlns="https://perilune.org/report"/>' * 2])
def test_the_annotation_holds_just_one_report(folder, loaded, inside):
    text = with_report(shipped_ssd(NAME), "@")
    begin, end = text.index("<Report"), text.index("</Report>") + len("</Report>")
    (folder / "SystemStructure.ssd").write_text(text[:begin] + inside + text[end:], encoding="utf-8")
    with pytest.raises(InputError, match=r"line \d+"):
        read_figures(prepare_system(folder, SystemOptions(), loaded))


def test_validate_and_run_refuse_alike_with_a_page_and_without(folder, tmp_path, capsys):
    declare(folder, '<Band signal="plant.angels" low="0"/>')
    page = tmp_path / "x.html"
    lines = []
    for arguments in (["validate", str(folder)], ["run", str(folder), "--report", str(page)], ["run", str(folder)]):
        assert main(arguments) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        lines += captured.err.splitlines()
    assert len(lines) == 3
    assert lines[0] == lines[1] == lines[2]
    assert not page.exists()


def test_ours_is_valid_and_its_archive_carries_it(tmp_path, capsys):
    archive = pack_system(SYSTEMS / NAME, [BUILD / "fmus" / "native"], tmp_path)
    assert main(["validate", NAME, str(archive)]) == 0
    assert capsys.readouterr().err == ""
    assert read_figures(prepare_system(archive)) == read_figures(prepare_system(NAME)) != []


def test_signals_are_those_that_a_flight_records(tiny, tmp_path):
    left = component("left", "cross", "output ya Real m; output yb Real m")
    right = component("right", "cross", "input a Real m; output ya Real m; output yb Real m")
    wires = connection("left.ya", "right.a") + connection("right.ya", "out")
    ssd = document(system(left, right, connections=wires, declared="output out Real m; output idle Real m"))
    prepared = prepare_system(pack(tmp_path / "s.ssp", tiny, ssd))
    with Simulation(prepared) as simulation:
        result = simulation.fly()
    actual = make_layout(prepared.network, prepared.settings)
    assert actual.types == result.types
    assert actual.units == result.units


def swapped(tmp_path, tiny, inside, use):
    """Return a system of an angle and a ramp, without declared connectors, with an FMU put in."""
    parts = system(component("body", "angle"), component("ramp", "ramp"))
    path = pack(tmp_path / "s.ssp", tiny, with_report(document(parts), inside))
    options = SystemOptions(use={slot: str(tiny / f"{name}.fmu") for slot, name in use.items()})
    return read_figures(prepare_system(path, options))


def test_what_an_fmu_that_is_put_in_lacks_is_said_and_not_refused(tmp_path, tiny):
    inside = (
        '<Band title="Attitude" signal="body.y" low="0" unit="deg"/>\n'
        '<Error estimate="ramp.y" truth="ramp.y" sigma="body.y"/>\n'
        '<Pulses lengths="ramp.y" count="ramp.count"/>'
    )
    with pytest.raises(InputError, match=r"sigma body\.y: its unit is rad, but m is required"):
        swapped(tmp_path, tiny, inside, {})  # the system's own FMUs are its own fault
    with pytest.raises(InputError, match=r"Pulses \(line \d+\): lengths ramp\.y: its unit is m, but s is required"):
        swapped(tmp_path, tiny, inside, {"body": "ramp"})
    attitude, error, pulses = swapped(tmp_path, tiny, inside, {"body": "whole", "ramp": "gain"})
    assert attitude == UnavailableFigure("Attitude", ("signal body.y: no such signal, with whole as body",))
    assert isinstance(error, ErrorFigure)
    assert error.sigma is None
    assert error.notes == ("Left out: sigma body.y: no such signal, with whole as body.",)
    assert pulses == UnavailableFigure(
        "Pulses", ("lengths ramp.y: its unit is m, but s is required, with gain as ramp",)
    )


def test_units_with_factor_and_offset(tmp_path, tiny):
    parts = system(component("ramp", "ramp", "output y Real m"))
    inside = (
        '<Band signal="ramp.y" low="0.001" unit="km"/>\n<Band signal="ramp.y" low="0.001" unit="km" about="3"/>\n'
        '<Band signal="ramp.count" low="2"/>'
    )
    lengths, less, count = read_figures(
        prepare_system(pack(tmp_path / "s.ssp", tiny, with_report(document(parts), inside)))
    )
    assert (lengths.signal.factor, lengths.signal.offsets) == (1e-3, (0.0,))
    assert (less.signal.factor, less.signal.offsets, less.about) == (1e-3, (-3e-3,), (3e-3,))
    assert (count.signal.unit, count.low) == (None, 2.0)
