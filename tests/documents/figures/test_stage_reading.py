"""Declared phases, budgets, limits, paths and curves of a system, and errors that name their place.

Truth: the declaration as written, the number of the line on which its wrong element begins, and the factors of units.
"""

import math
import shutil

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.design.trajectories.stored_bound import MissingBound, StoredBound
from perilune.analysis.documents.figures import stage_readers
from perilune.analysis.documents.figures.declared import (
    Arc,
    BoundValues,
    BudgetFigure,
    BudgetItem,
    CurveFigure,
    LimitsFigure,
    PathFigure,
    PhasesFigure,
    UnavailableFigure,
)
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS
from tests.support.builders import component, document, pack, system
from tests.support.pages.declaring import shipped_ssd, with_report

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "orbital_attitude"
PHASES = (
    '<Phases signal="plant.status" spent="plant.jet_seconds" status="pulses.pulse_count">\n'
    '<Phase value="1" name="first" until="observer.yaw_sigma"/>\n<Phase value="1" name="then this"/>\n'
    '<Phase value="3" name="last"/>\n<Meaning value="2" says="it is late"/>\n</Phases>'
)
SPACE = "plant.angles[1]"


@pytest.fixture(scope="module")
def loaded():
    """Return the FMUs of the system, loaded once."""
    return {}


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(SYSTEMS / NAME, tmp_path / NAME)
    return tmp_path / NAME


def read(folder, loaded, inside):
    (folder / "SystemStructure.ssd").write_text(with_report(shipped_ssd(NAME), inside), encoding="utf-8")
    return read_figures(prepare_system(folder, SystemOptions(), loaded))


def test_phases_and_limits(folder, loaded):
    limits = '<Limits title="End"><Limit signal="plant.angles[2]" least="-1" most="2" unit="deg" name="yaw"/></Limits>'
    phases, actual = read(folder, loaded, f"{PHASES}\n{limits}")
    assert isinstance(phases, PhasesFigure)
    assert [(phase.value, phase.name) for phase in phases.phases] == [(1, "first"), (1, "then this"), (3, "last")]
    assert [phase.until and phase.until.label for phase in phases.phases] == ["observer.yaw_sigma", None, None]
    assert (phases.title, phases.spent.label, phases.spent.unit_name) == ("plant.status", "plant.jet_seconds", "s")
    assert (phases.status.label, phases.status_times, phases.meanings) == (
        "pulses.pulse_count",
        None,
        {2: "it is late"},
    )
    assert isinstance(actual, LimitsFigure)
    (limit,) = actual.limits
    assert (limit.name, limit.least, limit.most, limit.signal.unit_name) == ("yaw", -1.0, 2.0, "deg")
    assert limit.signal.factor == pytest.approx(180.0 / math.pi, rel=1e-15)


def test_limits_of_vectors(folder, loaded):
    """Parameters, which come in rad as 17 deg, signals and numbers are subtracted; then what is left is measured."""
    inside = (
        '<Limits><Limit signal="plant.angles" measure="length" most="9" unit="deg"/>'
        '<Limit signal="plant.angles" measure="largest" most="9" less="plant.initial_angles" unit="deg"/>'
        '<Limit signal="plant.angles" measure="largest" most="9" less="plant.angles" unit="deg"/>'
        '<Limit signal="plant.angles" measure="length" most="9" about="0.1 0 -0.2"/>'
        '<Limit signal="plant.angles[2]" most="9" less="plant.initial_angles[2]" unit="deg"/></Limits>'
    )
    (actual,) = read(folder, loaded, inside)
    start = {f"plant.angles[{place}]": np.array([angle]) for place, angle in ((1, 0.4), (2, -0.5), (3, 0.6))}
    length, initial, itself, shifted, one = (limit.value(start) for limit in actual.limits)
    assert length == pytest.approx(math.degrees(math.hypot(0.4, 0.5, 0.6)), rel=1e-14)
    assert initial == pytest.approx(abs(-math.degrees(0.5) - 17.0), rel=1e-14)
    assert itself == 0.0
    assert shifted == pytest.approx(math.hypot(0.3, 0.5, 0.8), rel=1e-14)
    assert one == pytest.approx(-math.degrees(0.5) - 17.0, rel=1e-14)


def test_statuses_with_times(folder, loaded):
    inside = '<Phases signal="plant.status" status_times="pulses.remainder"><Phase value="1" name="a"/></Phases>'
    (phases,) = read(folder, loaded, inside)
    assert len(phases.status_times.names) == 3
    assert (phases.status, phases.spent, phases.meanings) == (None, None, {})


def test_paths_and_curves(folder, loaded):
    path, curve, bare = read(
        folder,
        loaded,
        '<Path x="plant.angles[1]" y="plant.angles[2]" equal="true" where="plant.status" from="1" to="3">\n'
        '<Point x="plant.angles[2]" y="plant.angles[3]" name="goal"/></Path>\n'
        '<Curve title="All" signals="plant.angles[1] plant.angles[3]" labels="roll pitch" together="true" unit="deg"'
        ' high="3" where="plant.status" to="2"/>\n<Curve signals="plant.jet_seconds"/>',
    )
    assert isinstance(path, PathFigure)
    assert (path.title, path.equal, path.x.label) == ("plant.angles[2] over plant.angles[1]", True, "plant.angles[1]")
    assert (path.rows.signal.label, path.rows.low, path.rows.high) == ("plant.status", 1.0, 3.0)
    assert [(point.x.label, point.y.label, point.name) for point in path.points] == [
        ("plant.angles[2]", "plant.angles[3]", "goal")
    ]
    assert isinstance(curve, CurveFigure)
    assert ([signal.unit_name for signal in curve.signals], curve.labels) == (["deg", "deg"], ("roll", "pitch"))
    assert (curve.low, curve.high, curve.together, curve.rows.low, curve.rows.high) == (None, 3.0, True, None, 2.0)
    assert (bare.title, bare.labels, bare.together, bare.rows) == (
        *["plant.jet_seconds"] * 1,
        ("plant.jet_seconds",),
        False,
        None,
    )


def test_an_arc_takes_its_radius_from_a_parameter():
    arcs = [figure.x for figure in read_figures(prepare_system("landing_mission")) if isinstance(figure, PathFigure)]
    assert [(arc.position.label, arc.radius) for arc in arcs if isinstance(arc, Arc)] == [
        ("plant.position", 1737400.0)
    ] * 2
    other = prepare_system("landing_mission", SystemOptions(set={"moon_radius": 1.7e6}))
    assert [figure.x.radius for figure in read_figures(other) if isinstance(getattr(figure, "x", None), Arc)] == [
        1.7e6
    ] * 2


BUDGET = (
    '<Budget title="Spent"><Item name="a" phases="first, then this" plus="landing, transfer"/>'
    '<Item name="b" minus="landing"/></Budget>'
)
INPUTS = {"mass": 940.0, "braking.altitude": 2400.0, "transfer.mass": 526.0, "transfer.aside": (3.0, 4.0)}
NAMES = ("landing", "braking", "transfer")
STORED = StoredBound(400.5, 290.0, 240, (), {"braking": 399.0, "transfer": 21.0}, "", INPUTS)


def keep(monkeypatch, bound):
    """Declare a bound of these inputs for the system, and store this one of it."""
    monkeypatch.setattr(stage_readers, "read_inputs", lambda prepared: INPUTS)
    monkeypatch.setattr(stage_readers, "find_bound", lambda prepared: bound)


@pytest.mark.parametrize(
    ("bound", "values"),
    [
        (STORED, BoundValues(NAMES, {"landing": 400.5, "braking": 399.0, "transfer": 21.0})),
        (MissingBound("make it"), BoundValues(NAMES, {}, "make it")),
    ],
    ids=["stored", "missing"],
)
def test_a_budget_takes_the_bound_that_the_system_keeps(folder, loaded, monkeypatch, bound, values):
    keep(monkeypatch, bound)
    phases, budget = read(folder, loaded, f"{PHASES}\n{BUDGET}")
    assert isinstance(budget, BudgetFigure)
    assert (budget.title, budget.of, budget.bound) == ("Spent", phases, values)
    first, second = budget.items
    assert first == BudgetItem("a", ("first", "then this"), ("landing", "transfer"), ())
    assert second == BudgetItem("b", (), (), ("landing",))


ONE = '<Phase value="1" name="a"/>'
WRONG = {
    # the wrong element, which element the message names, words of it
    "no phase": ('<Phases signal="plant.status"/>', "Phases", "no Phase"),
    "phases of a Real": ('<Phases signal="plant.jet_seconds"/>', "Phases", "signal plant.jet_seconds is not Integer"),
    "two ways to tell a status": (
        f'<Phases signal="plant.status" status="plant.status" status_times="pulses.remainder">{ONE}</Phases>',
        "Phases", "has both status and status_times; give one of the two",
    ),
    "times of a status that are none": (
        f'<Phases signal="plant.status" status_times="plant.angles">{ONE}</Phases>',
        "Phases", "status_times plant.angles: its unit is rad, but s is required",
    ),
    "a value that is not whole": (
        '<Phases signal="plant.status"><Phase value="1.5" name="a"/></Phases>', "Phase", "value 1.5 is not an integer"
    ),
    "a name twice": (
        f'<Phases signal="plant.status">{ONE}<Phase value="2" name="a"/></Phases>', "Phase", "name a occurs twice"
    ),
    "a part without an end": (
        f'<Phases signal="plant.status">{ONE}<Phase value="1" name="b"/></Phases>', "Phase", "the preceding Phase of"
    ),
    "a part that nothing follows": (
        '<Phases signal="plant.status"><Phase value="1" name="a" until="plant.status"/></Phases>',
        "Phase", "the last Phase of value 1 has until",
    ),
    "an unknown end": (
        '<Phases signal="plant.status"><Phase value="1" name="a" until="plant.done"/></Phases>',
        "Phase", "until plant.done: no such signal",
    ),
    "a meaning twice": (
        f'<Phases signal="plant.status">{ONE}<Meaning value="1" says="a"/><Meaning value="1" says="b"/></Phases>',
        "Meaning", "value 1 occurs twice",
    ),
    "spent that is a vector": (
        f'<Phases signal="plant.status" spent="plant.angles">{ONE}</Phases>', "Phases", "spent plant.angles is a vector"
    ),
    "no limit": ("<Limits/>", "Limits", "no Limit"),
    "a limit of nothing": (f'<Limits><Limit signal="{SPACE}"/></Limits>', "Limit", "neither least nor most"),
    "limits swapped": (
        f'<Limits><Limit signal="{SPACE}" least="2" most="1"/></Limits>', "Limit", "least = 2 is not below most = 1"
    ),
    "a limit of a vector": ('<Limits><Limit signal="plant.angles" most="1"/></Limits>', "Limit", "is a vector"),
    "an unknown measure": (
        '<Limits><Limit signal="plant.angles" measure="size" most="1"/></Limits>',
        "Limit", "measure size is unknown; use one of largest, length",
    ),
    "less of another size": (
        '<Limits><Limit signal="plant.angles" less="plant.orbital_rate" measure="length" most="1"/></Limits>',
        "Limit", "less plant.orbital_rate has 1 elements, plant.angles has 3 elements",
    ),
    "less in another unit": (
        '<Limits><Limit signal="plant.angles" less="regulator.angle_poles" measure="length" most="1"/></Limits>',
        "Limit", "less regulator.angle_poles: its unit is 1/s, but rad is required",
    ),
    "less of nothing": (
        '<Limits><Limit signal="plant.angles" less="plant.target" measure="length" most="1"/></Limits>',
        "Limit", "less plant.target: no such signal",
    ),
    "less twice": (
        '<Limits><Limit signal="plant.angles[1]" less="plant.angles[2]" about="0" most="1"/></Limits>',
        "Limit", "has both about and less; give one of the two",
    ),
    "a limit in another unit": (
        f'<Limits><Limit signal="{SPACE}" most="1" unit="s"/></Limits>', "Limit", "its unit is rad, but s is required"
    ),
    "a path without x": (f'<Path y="{SPACE}"/>', "Path", "either x, or arc and radius"),
    "a path with both": (f'<Path x="{SPACE}" arc="plant.angles" radius="a" y="{SPACE}"/>', "Path", "either x, or"),
    "an arc without radius": (f'<Path arc="plant.angles" y="{SPACE}"/>', "Path", "either x, or arc and radius"),
    "an arc of angles": (
        f'<Path arc="plant.angles" radius="plant.orbital_rate" y="{SPACE}"/>', "Path", "its unit is rad, but m"
    ),
    "unlike axes to one scale": (
        f'<Path x="{SPACE}" y="plant.jet_seconds" equal="true"/>', "Path", "have different units; leave out equal"
    ),
    "neither true nor false": (f'<Path x="{SPACE}" y="{SPACE}" equal="yes"/>', "Path", "equal 'yes' is neither true"),
    "a point of another unit": (
        f'<Path x="{SPACE}" y="{SPACE}"><Point x="{SPACE}" y="plant.jet_seconds" name="a"/></Path>',
        "Point", "y plant.jet_seconds: its unit is s, but rad",
    ),
    "a point without name": (
        f'<Path x="{SPACE}" y="{SPACE}"><Point x="{SPACE}" y="{SPACE}"/></Path>', "Point", "no name"
    ),
    "where without ends": (f'<Path x="{SPACE}" y="{SPACE}" where="plant.status"/>', "Path", "where needs from or to"),
    "ends without where": (f'<Path x="{SPACE}" y="{SPACE}" to="3"/>', "Path", "to needs where"),
    "ends swapped": (
        f'<Path x="{SPACE}" y="{SPACE}" where="plant.status" from="3" to="2"/>', "Path", "from = 3 is above to = 2"
    ),
    "a curve of a vector": ('<Curve signals="plant.angles"/>', "Curve", "signals plant.angles: no such scalar"),
    "curves of two units": (
        f'<Curve signals="{SPACE} plant.jet_seconds"/>', "Curve", "plant.jet_seconds: its unit is s, but rad"
    ),
    "labels of another number": (
        f'<Curve signals="{SPACE}" labels="a b"/>', "Curve", "labels has 2 names, but signals has 1; give"
    ),
    "a curve's limits swapped": (f'<Curve signals="{SPACE}" low="1" high="0"/>', "Curve", "low = 1 is not below"),
    "a budget without phases": ('<Budget><Item name="a" plus="x"/></Budget>', "Budget", "0 Phases elements precede it"),
}  # fmt: skip
OF_PHASES = {
    "a budget of nothing": ("<Budget/>", "Budget", "no Item"),
    "an item of nothing": ('<Budget><Item name="a"/></Budget>', "Item", "has neither phases nor plus"),
    "an unknown phase": (
        '<Budget><Item name="a" phases="first, next"/></Budget>', "Item",
        "phases next: no such phase; use one of first, last, then this",
    ),
    "a phase twice": ('<Budget><Item name="a" phases="last, last"/></Budget>', "Item", "a name is empty or repeated"),
    "a bound that is not declared": (
        '<Budget><Item name="a" plus="landing"/></Budget>', "Item", "landing, but the SSD declares no bound"
    ),
}  # fmt: skip


def refused(folder, loaded, before, bad, element, words):
    with pytest.raises(InputError) as caught:
        read(folder, loaded, f"{before}\n{bad}")
    text = (folder / "SystemStructure.ssd").read_text(encoding="utf-8")
    line = text[: text.index(bad)].count("\n") + 1
    message = str(caught.value)
    assert message.startswith(f"{folder}/SystemStructure.ssd: {element} (line {line}): ")
    assert words in message
    assert "\n" not in message


@pytest.mark.parametrize("name", WRONG)
def test_everything_wrong_is_refused_with_its_line(folder, loaded, name):
    refused(folder, loaded, "", *WRONG[name])


@pytest.mark.parametrize("name", OF_PHASES)
def test_budgets_that_are_wrong_are_refused_with_their_line(folder, loaded, name):
    refused(folder, loaded, PHASES, *OF_PHASES[name])


def test_a_budget_needs_what_phases_use_up_and_a_bound_that_there_is(folder, loaded, monkeypatch):
    bare = PHASES.replace(' spent="plant.jet_seconds"', "")
    item = '<Budget><Item name="a" phases="last"/></Budget>'
    refused(folder, loaded, bare, item, "Budget", "the preceding Phases lacks the attribute spent")
    keep(monkeypatch, STORED)
    unknown = '<Budget><Item name="a" plus="landng"/></Budget>'
    refused(folder, loaded, PHASES, unknown, "Item", "landng: no such bound; use one of landing, braking, transfer")


def test_what_an_fmu_that_is_put_in_lacks_is_said(tiny_folder, tmp_path):
    """Without the signal of the phases neither they nor their budget are drawn; without spent the budget is not."""
    tiny = tiny_folder / "native"
    inside = (
        '<Phases title="Steps" signal="ramp.count" spent="{}"><Phase value="1" name="a"/></Phases>\n'
        '<Budget><Item name="a" phases="a"/></Budget>'
    )
    parts = document(system(component("ramp", "ramp"), component("body", "angle")))

    def figures(spent, use):
        path = pack(tmp_path / "s.ssp", tiny, with_report(parts, inside.format(spent)))
        options = SystemOptions(use={slot: str(tiny / f"{name}.fmu") for slot, name in use.items()})
        return read_figures(prepare_system(path, options))

    assert [type(figure) for figure in figures("ramp.y", {})] == [PhasesFigure, BudgetFigure]
    phases, budget = figures("ramp.y", {"ramp": "gain"})
    assert phases == UnavailableFigure("Steps", ("signal ramp.count: no such signal, with gain as ramp",))
    assert budget == UnavailableFigure("Budget", ("the consumption of phases is not available",))
    phases, budget = figures("body.y", {"body": "whole"})
    assert phases.notes == ("Left out: spent body.y: no such signal, with whole as body.",)
    assert budget == UnavailableFigure("Budget", ("the consumption of phases is not available",))


def test_limits_that_an_event_has_to_happen_for(folder, loaded):
    inside = '<Limits when="{}"><Limit signal="plant.angles[2]" most="2" unit="deg"/></Limits>'
    (actual,) = read(folder, loaded, inside.format("pulses.pulse_count"))
    assert actual.when.names == ("pulses.pulse_count",)
    refused(folder, loaded, "", inside.format("pulses.pulse_cout"), "Limits", "when pulses.pulse_cout: no such signal")
    refused(folder, loaded, "", inside.format("plant.angles"), "Limits", "when plant.angles is a vector")


def test_limits_of_an_fmu_that_is_put_in_and_lacks_them_are_not_evaluated(tiny_folder, tmp_path, capsys):
    """The flight ends well, and what was to hold of it nobody knows: exit status 1."""
    tiny = tiny_folder / "native"
    parts = document(system(component("ramp", "ramp")))
    limits = '<Limits title="End"><Limit signal="ramp.count" most="1e9"/></Limits>'
    path = str(pack(tmp_path / "s.ssp", tiny, with_report(parts, limits)))
    assert main(["run", path]) == 0
    capsys.readouterr()
    use = ["--use", f"ramp={tiny / 'gain.fmu'}", "--open-inputs", "start"]
    flight = perilune.simulate(path, use={"ramp": tiny / "gain.fmu"}, open_inputs="start")
    assert [limit["verdict"] for limit in flight.limits] == ["not evaluated"]
    assert [limit["verdict"] for limit in perilune.simulate(path).limits] == ["met"]
    assert main(["run", path, *use]) == 1
    captured = capsys.readouterr()
    why = "signal ramp.count: no such signal, with gain as ramp"
    assert f"End: not evaluated, {why}" in captured.out.splitlines()
    assert captured.err.endswith(f"limits not evaluated: {why}\n")


def test_ours_is_valid_and_its_bound_is_kept(capsys):
    assert main(["validate", "landing_mission"]) == 0
    assert capsys.readouterr().out == "landing_mission: OK\n"  # no note: the bound that it keeps is that of its values
    (budget,) = (
        figure for figure in read_figures(prepare_system("landing_mission")) if isinstance(figure, BudgetFigure)
    )
    assert set(budget.bound.names) == set(budget.bound.values) == {"landing", "braking", "transfer", "approach"}
    other = prepare_system("landing_mission", SystemOptions(set={"sequencer.redesignation_1[1]": 0.0}))
    (budget,) = (figure for figure in read_figures(other) if isinstance(figure, BudgetFigure))
    assert "was computed for different values of transfer.aside" in budget.bound.missing
