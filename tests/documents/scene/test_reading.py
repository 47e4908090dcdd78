"""Declarations of a Scene, and their errors, each in one line that names the element.

Truth: the declaration as written, and the line number of the wrong element.
"""

import shutil

import pytest

from perilune.analysis.cli import main
from perilune.analysis.documents.figures.declared import UnavailableFigure
from perilune.analysis.documents.figures.figure_reader import read_figures
from perilune.analysis.documents.figures.scene.scene_elements import (
    Angles,
    Cartesian,
    Geographic,
    Line,
    Panel,
    Quaternion,
    SceneFigure,
    ThrustAxis,
    WindAngles,
)
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import SYSTEMS
from tests.support.builders import component, document, pack, system
from tests.support.pages.declaring import with_report

pytestmark = pytest.mark.usefixtures("fmus")
ROBOT, CAPSULE = "robot_rendezvous", "entry_attitude"
SPHERE = '<Surface kind="sphere" radius="plant.earth_radius" name="Earth"/>'
GEOGRAPHIC = 'longitude="plant.longitude" latitude="plant.latitude" height="plant.height"'
WIND = (
    'bank="plant.bank" sideslip_angle="plant.sideslip" angle_of_attack="plant.attack" '
    'flight_path_angle="plant.path_angle" heading="plant.course"'
)


@pytest.fixture(scope="module")
def loaded():
    """Return the FMUs of the systems, loaded once."""
    return {ROBOT: {}, CAPSULE: {}}


@pytest.fixture
def read(tmp_path, loaded):
    """Read the figures of a system with this in its report, and the text of its SSD."""

    def read_report(inside, name=ROBOT):
        folder = tmp_path / name
        if not folder.exists():
            shutil.copytree(SYSTEMS / name, folder)
        text = with_report((SYSTEMS / name / "SystemStructure.ssd").read_text(encoding="utf-8"), inside)
        (folder / "SystemStructure.ssd").write_text(text, encoding="utf-8")
        return read_figures(prepare_system(folder, SystemOptions(), loaded[name]))

    return read_report


def body(more="", inside="", name="it"):
    return f'<Body name="{name}" shape="box" size="1 2 3" {more}>{inside}</Body>'


def scene(*elements, more=""):
    return f"<Scene {more}>\n" + "\n".join(elements) + "\n</Scene>"


def test_all_that_can_be_declared(read):
    (whole,) = read(
        scene(
            '<Surface kind="plane"/>',
            body(
                'position="robot.position" quaternion="robot.quaternion" at="0 0 1"',
                '<Thrust signal="robot.impulse" at="0 0 -1" along="0 3 4"/>'
                '<Jets forces="robot.jet_force"><Jet at="1 0 0" along="0 0 2"/><Jet at="0 1 0" along="1 0 0"/>'
                '<Jet at="0 0 1" along="0 1 0"/></Jets><Panel size="2 0.1 1" at="0 1 0"/>',
            ),
            body('axis="robot.angular_velocity"', name="other"),
            '<Site name="mark" position="guidance.target_position"/>',
            '<Site name="plan" position="guidance.planned_position"/>',
            '<Site name="flag" position="-1 0.5 2e3"/>',
            '<Line from="it" to="ground" while="ranger.sample_count" name="beam"/>',
            '<Line from="other" to="mark"/>',
            '<Arrow name="spin" from="mark" signal="robot.angular_velocity" frame="it" length="2.5" colour="sky"/>',
            '<Arrow name="way" from="it" signal="robot.position"/>',
            more='title="Meeting" frame="inertial" axes="east north up"',
        )
    )
    assert isinstance(whole, SceneFigure)
    assert (whole.title, whole.frame, whole.axes, whole.up) == ("Meeting", "inertial", ("east", "north", "up"), "z")
    assert whole.surface.radius is None
    first, second = whole.bodies
    assert (first.name, first.shape, first.size, first.at) == ("it", "box", (1.0, 2.0, 3.0), (0.0, 0.0, 1.0))
    assert isinstance(first.position, Cartesian)
    assert first.position.signal.names == ("robot.position[1]", "robot.position[2]", "robot.position[3]")
    assert isinstance(first.attitude, Quaternion)
    assert len(first.attitude.signal.names) == 4
    (thrust,) = first.thrusts
    assert (thrust.signal.label, thrust.at, thrust.along) == ("robot.impulse", (0.0, 0.0, -1.0), (0.0, 0.6, 0.8))
    (jets,) = first.jets
    assert (jets.pulses, jets.couple, jets.count) == (False, False, None)
    assert jets.along == ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    assert second.position is None
    assert isinstance(second.attitude, ThrustAxis)
    mark, plan, flag = whole.sites
    assert mark.position == (469.8463103929542, 171.01007166283435, 0.0)  # a parameter, of nominal.ssv
    assert plan.position.label == "guidance.planned_position"
    assert flag.position == (-1.0, 0.5, 2000.0)
    beam, line = whole.lines
    assert (beam.name, beam.start, beam.end, beam.condition.label) == ("beam", "it", "ground", "ranger.sample_count")
    assert line == Line("other to mark", "other", "mark", None)
    assert first.panels == (Panel((0.0, 1.0, 0.0), (2.0, 0.1, 1.0)),)
    spin, way = whole.arrows
    assert (spin.name, spin.start, spin.frame, spin.length, spin.colour) == ("spin", "mark", "it", 2.5, "sky")
    assert spin.signal.names == tuple(f"robot.angular_velocity[{k}]" for k in (1, 2, 3))
    assert (way.frame, way.length, way.colour) == (None, None, None)


def test_a_position_over_a_sphere_and_wind_angles(read):
    (whole,) = read(scene(SPHERE, body(f"{GEOGRAPHIC} {WIND}")), CAPSULE)
    (capsule,) = whole.bodies
    assert whole.surface.centre == (0.0, 0.0, -6371000.0)
    assert (whole.surface.name, whole.surface.radius) == ("Earth", 6371000.0)
    assert whole.axes == ("east", "north", "up")
    assert isinstance(capsule.position, Geographic)
    assert isinstance(capsule.attitude, WindAngles)
    assert capsule.attitude.heading.label == "plant.course"


@pytest.mark.parametrize(
    ("angles", "sequence", "names"),
    [
        ("plant.bank", "z", ["plant.bank"]),
        ("plant.bank plant.attack", "xz", ["plant.bank", "plant.attack"]),
    ],
)
def test_angles_are_a_vector_or_scalars(read, angles, sequence, names):
    (whole,) = read(scene(body(f'angles="{angles}" sequence="{sequence}"')), CAPSULE)
    attitude = whole.bodies[0].attitude
    assert isinstance(attitude, Angles)
    assert [signal.label for signal in attitude.signals] == names
    assert attitude.sequence == sequence


JET = '<Jet at="1 0 0" along="0 0 1"/>'
WRONG = {
    # the system, what is wrong with the lines before and after it, which element the message names, words of it
    "no body": (ROBOT, '<Surface kind="plane"/>', "Scene", "no Body"),
    "unknown element": (ROBOT, "<Bdoy/>", "Bdoy", "unknown element; use one of Body, Arrow, Line, Site, Surface"),
    "unknown attribute": (ROBOT, body('colour="red"'), "Body", "unknown attribute colour"),
    "no size": (ROBOT, '<Body name="x" shape="box"/>', "Body", "no size"),
    "two numbers": (ROBOT, '<Body name="x" shape="box" size="1 2"/>', "Body", "size has 2 numbers"),
    "flat": (ROBOT, '<Body name="x" shape="box" size="1 2 0"/>', "Body", "size 1 2 0 is not positive"),
    "unknown shape": (ROBOT, '<Body name="x" shape="bx" size="1 2 3"/>', "Body", "shape bx is unknown"),
    "no such position": (ROBOT, body('position="robot.place"'), "Body", "position robot.place: no such signal"),
    "position of another size": (
        ROBOT, body('position="robot.quaternion"'), "Body", "position robot.quaternion: its unit is 1, but m"
    ),
    "an element of a position": (
        ROBOT, body('position="robot.position[1]"'), "Body", "position robot.position[1] has 1 elements, but 3"
    ),
    "quaternion of another size": (
        ROBOT, body('quaternion="robot.position"'), "Body", "quaternion robot.position has 3 elements, but 4"
    ),
    "two attitudes": (
        ROBOT, body('quaternion="robot.quaternion" axis="robot.position"'), "Body",
        "attitudes of two kinds, quaternion and axis",
    ),
    "angles without a sequence": (CAPSULE, body('angles="plant.bank"'), "Body", "angles without sequence"),
    "a sequence of no axes": (
        CAPSULE, body('angles="plant.bank" sequence="roll"'), "Body", "sequence 'roll' does not have one to three axes"
    ),
    "angles of another number": (
        CAPSULE, body('angles="plant.bank plant.attack" sequence="zyx"'), "Body",
        "angles has 2 signals, but sequence has 3 axes",
    ),
    "angles that are none": (
        CAPSULE, body('angles="plant.height" sequence="z"'), "Body", "its unit is m, but rad is required"
    ),
    "wind angles without a position": (
        CAPSULE, body(WIND), "Body", "wind angles need longitude, latitude and height"
    ),
    "wind angles without a heading": (
        CAPSULE, SPHERE + body(f"{GEOGRAPHIC} {WIND}".partition("heading")[0]), "Body", "bank without heading"
    ),
    "longitude without a sphere": (CAPSULE, body(GEOGRAPHIC), "Body", "longitude needs a sphere"),
    "longitude alone": (
        CAPSULE, body('longitude="plant.longitude"'), "Body", "needs either position, or longitude, latitude, height"
    ),
    "a sphere without radius": (ROBOT, '<Surface kind="sphere"/>', "Surface", "a sphere needs a radius"),
    "a plane with a radius": (
        ROBOT, '<Surface kind="plane" radius="robot.mass"/>', "Surface", "a plane has no radius"
    ),
    "no such radius": (
        ROBOT, '<Surface kind="sphere" radius="robot.radius"/>', "Surface", "radius robot.radius: no such parameter"
    ),
    "unknown kind": (ROBOT, '<Surface kind="flat"/>', "Surface", "kind 'flat' is unknown"),
    "thrust that is a vector": (
        ROBOT, body("", '<Thrust signal="robot.jet_thrust"/>'), "Thrust", "signal robot.jet_thrust is a vector"
    ),
    "thrust without direction": (
        ROBOT, body("", '<Thrust signal="robot.impulse" along="0 0 0"/>'), "Thrust", "along has no direction"
    ),
    "jets of two kinds": (
        ROBOT, body("", f'<Jets forces="robot.impulse" pulses="robot.impulse">{JET}</Jets>'), "Jets",
        "needs either forces or pulses",
    ),
    "too few jets": (
        ROBOT, body("", f'<Jets forces="robot.jet_thrust">{JET}</Jets>'), "Jets",
        "it has 1 Jet, robot.jet_thrust has 8 elements",
    ),
    "pulses that are no times": (
        ROBOT, body("", f'<Jets pulses="robot.impulse">{JET}</Jets>'), "Jets", "its unit is N.s, but s is required"
    ),
    "count without pulses": (
        ROBOT, body("", f'<Jets forces="robot.impulse" count="ranger.sample_count">{JET}</Jets>'), "Jets",
        "count needs pulses",
    ),
    "a jet without a point": (
        ROBOT, body("", '<Jets forces="robot.impulse"><Jet along="0 0 1"/></Jets>'), "Jet", "no at"
    ),
    "a line from nowhere": (ROBOT, '<Line from="nobody" to="it"/>', "Line", "from nobody: no such Body or Site"),
    "a line to no ground": (ROBOT, '<Line from="it" to="ground"/>', "Line", "to ground needs a Surface"),
    "a site of another size": (
        ROBOT, '<Site name="x" position="robot.mass"/>', "Site", "position robot.mass has 1 elements, but 3"
    ),
    "an arrow without a signal": (ROBOT, '<Arrow name="a" from="it"/>', "Arrow", "no signal"),
    "an arrow from nowhere": (
        ROBOT, '<Arrow name="a" from="nobody" signal="robot.position"/>', "Arrow", "from nobody: no such Body or Site"
    ),
    "an arrow along a scalar": (
        ROBOT, '<Arrow name="a" from="it" signal="robot.impulse"/>', "Arrow",
        "signal robot.impulse has 1 elements, but 3",
    ),
    "an arrow in unknown axes": (
        ROBOT, '<Arrow name="a" from="it" signal="robot.position" frame="orbit"/>', "Arrow",
        "frame orbit: no such Body; use one of it; leave out frame for the axes of the scene",
    ),
    "an arrow in axes without attitude": (
        ROBOT, '<Arrow name="a" from="it" signal="robot.position" frame="it"/>', "Arrow",
        "frame it: this Body has no attitude",
    ),
    "an arrow of no length": (
        ROBOT, '<Arrow name="a" from="it" signal="robot.position" length="0"/>', "Arrow",
        "length '0' is not a positive number",
    ),
    "an arrow of an unknown colour": (
        ROBOT, '<Arrow name="a" from="it" signal="robot.position" colour="red"/>', "Arrow", "colour red is unknown"
    ),
    "a flat panel": (ROBOT, body("", '<Panel size="1 0 1"/>', "other"), "Panel", "size 1 0 1 is not positive"),
    "a plane with a centre": (ROBOT, '<Surface kind="plane" centre="0 0 0"/>', "Surface", "a plane has no centre"),
    "a name twice": (ROBOT, body(), "Body", "name it occurs twice or is reserved"),
    "a name that is reserved": (ROBOT, body(name="ground"), "Body", "name ground occurs twice or is reserved"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_everything_wrong_is_refused_with_its_line(read, tmp_path, name):
    system_name, bad, element, words = WRONG[name]
    whole = scene(bad) if "no body" in name else scene(body(), bad)
    with pytest.raises(InputError) as caught:
        read(whole, system_name)
    file = tmp_path / system_name / "SystemStructure.ssd"
    text = file.read_text(encoding="utf-8")
    position = text.rindex(f"<{element}", 0, text.rindex(bad) + len(bad))
    message = str(caught.value)
    assert message.startswith(f"{file}: {element} (line {text[:position].count(chr(10)) + 1}): ")
    assert words in message
    assert "\n" not in message


@pytest.mark.parametrize(
    ("more", "elements", "words"),
    [
        ('axes="x y"', (body(),), "axes has 2 names"),
        ('up="w"', (body(),), "up 'w' is not an axis"),
        ('up="y"', ('<Surface kind="plane"/>', body()), "up y cannot be combined with a Surface, whose normal is z"),
        ('frame="inertial"', (SPHERE, body(GEOGRAPHIC)), "frame cannot be combined with longitude and latitude"),
        ("", (SPHERE, body(GEOGRAPHIC), body(name="other")), "bodies have positions of two kinds"),
        (
            "",
            (SPHERE, body(GEOGRAPHIC), '<Site name="x" position="plant.wind"/>'),
            "a Site needs bodies with position, not longitude and latitude",
        ),
        ("", ('<Surface kind="plane"/>', '<Surface kind="plane"/>', body()), "a second Surface"),
        ("", (f"</Scene><Scene>{body()}",), "no Body"),
        (
            "",
            (SPHERE.replace("/>", ' centre="0 0 0"/>'), body(GEOGRAPHIC)),
            "centre cannot be combined with longitude and latitude",
        ),
        (
            "",
            (body('axis="plant.wind"'), '<Arrow name="a" from="it" signal="plant.wind" frame="it"/>'),
            "frame it: this Body has an axis alone, whose roll is unknown; name a Body with an attitude",
        ),
    ],
)
def test_what_does_not_go_together_is_refused(read, more, elements, words):
    with pytest.raises(InputError, match=words):
        read(scene(*elements, more=more), CAPSULE)


def test_a_second_scene_is_refused(read):
    with pytest.raises(InputError, match="a second Scene"):
        read(scene(body()) + scene(body()))


def test_validate_and_run_refuse_alike(read, tmp_path, capsys):
    with pytest.raises(InputError):
        read(scene(body('position="robot.place"')))
    for arguments in (["validate", str(tmp_path / ROBOT)], ["run", str(tmp_path / ROBOT)]):
        assert main(arguments) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert "position robot.place: no such signal" in line


def test_what_an_fmu_that_is_put_in_lacks_is_said_and_not_refused(tmp_path, tiny_folder):
    elements = system(component("hull", "ramp"), component("ramp", "ramp"))
    inside = scene(
        '<Surface kind="plane"/>',
        body("", '<Thrust signal="ramp.y"/>'),
        '<Line from="it" to="ground" while="ramp.count"/>',
        more='title="Meeting"',
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", with_report(document(elements), inside))

    def figures(**use):
        options = SystemOptions(use={slot: str(tiny_folder / "native" / f"{name}.fmu") for slot, name in use.items()})
        return read_figures(prepare_system(path, options))

    (whole,) = figures()
    assert isinstance(whole, SceneFigure)
    (less,) = figures(ramp="angle")
    assert isinstance(less, SceneFigure)
    assert (less.bodies[0].name, less.lines) == ("it", ())
    assert less.notes == ("Left out: while ramp.count: no such signal, with angle as ramp.",)
    inside = scene(body('angles="hull.count" sequence="z"'), more='title="Meeting"')
    path = pack(tmp_path / "t.ssp", tiny_folder / "native", with_report(document(elements), inside))
    (gone,) = figures(hull="angle")
    assert gone == UnavailableFigure("Meeting", ("angles hull.count: no such signal, with angle as hull",))
