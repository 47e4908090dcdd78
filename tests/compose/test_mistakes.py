"""Errors in a system.toml: one line each, reported together, exit status 2, nothing written.

Truth: the expected lines, written here.
"""

from __future__ import annotations

import pytest

from perilune.analysis.cli import main
from tests.support.pages.system_page import SHORT, SSD, write_system

pytestmark = pytest.mark.usefixtures("fmus")
ATTITUDE = '"star.measured_quaternion -> navigation.measured_quaternion"'
COUNT = '"star.sample_count -> navigation.star_count"'
TORQUE = '"control.torque_command -> wheels.torque_command"'
STARS = 'star = "star_inertial"'
COMPONENTS = "[components]\n"
SET = '"satellite.initial_quaternion" = [0.99, 0.1, 0, 0.1]'

MISTAKES = {
    "swapped ends": (
        TORQUE,
        '"wheels.torque_command -> control.torque_command"',
        "connections (line 16): wheels.torque_command -> control.torque_command: wheels.torque_command[1] is input and "
        "control.torque_command[1] is output; the ends are swapped: write control.torque_command -> "
        "wheels.torque_command",
    ),
    "two inputs": (
        TORQUE,
        '"wheels.torque_command -> control.wheel_momentum"',
        "wheels.torque_command[1] is input and control.wheel_momentum[1] is input; connect an output with an input",
    ),
    "a variable with a typo": (TORQUE, TORQUE.replace("torque_c", "torqe_c", 1), "of 19 known names: torque_command"),
    "a component with a typo": (
        TORQUE,
        TORQUE.replace("control", "contrl"),
        "no component contrl; use one of control,",
    ),
    "an input that is not connected": (
        '"satellite.wheel_speeds -> wheels.wheel_speeds",',
        "",
        "components.wheels (line 27): input wheels.wheel_speeds is not connected; connect it "
        "(satellite.wheel_speeds?), or list it under unconnected",
    ),
    "unequal sizes": (
        ATTITUDE,
        '"star.measured_quaternion -> navigation.measured_angular_velocity"',
        "sizes differ: star.measured_quaternion is 4 elements, navigation.measured_angular_velocity is 3 elements; "
        "connect elements, NAME[1] -> NAME[1]",
    ),
    "types that do not fit": (
        COUNT,
        '"star.measured_quaternion[1] -> navigation.star_count"',
        "is Integer; connect variables of the same type",
    ),
    "units that do not convert": (
        TORQUE,
        f'{TORQUE}, "satellite.wheel_momentum -> wheels.torque_command"',
        "units are not convertible: satellite.wheel_momentum[1] is in N.m.s, but wheels.torque_command[1] is in N.m;",
    ),
    "an input with two sources": (
        COUNT,
        f'{COUNT}, "gyros.sample_count -> navigation.star_count"',
        "navigation.star_count is driven twice, first by star.sample_count; remove one of the two",
    ),
    "no arrow": (COUNT, '"star.sample_count"', 'not a connection; write "COMPONENT.OUTPUT -> COMPONENT.INPUT"'),
    "an unknown connector of the system": (
        COUNT,
        f'{COUNT}, "star.sample_count -> finished"',
        "the system has no connector finished: [system] does not declare it",
    ),
    "a connector of the system without a connection": (
        COMPONENTS,
        '[system]\noutput = ["finished"]\n[components]\n',
        "system.output: finished: nothing is connected to it, so its type and unit are unknown; connect it, or",
    ),
    "an FMU that is not built": (
        STARS,
        'star = "star_inertal"',
        "components.star (line 23): no FMU star_inertal is built; the nearest of",
    ),
    "a parameter set that is not there": (
        COMPONENTS,
        'parameters = ["nominal.ssv"]\n[components]\n',
        "parameters: no parameter set nominal.ssv in the system's folder; none is available",
    ),
    "an unknown key": (COMPONENTS, "stoptime = 3\n[components]\n", "stoptime: unknown key; allowed here: name, desc"),
    "declared although connected": (
        COMPONENTS,
        'declare = ["star.sample_count"]\n[components]\n',
        "declare (line 21): star.sample_count: is already connected; remove it from this list",
    ),
    "an output left unconnected": (
        '["star.*"',
        '["satellite.status", "star.*"',
        "satellite.status: is output; name inputs here",
    ),
    "all inputs of no component": ('"star.*"', '"stars.*"', "unconnected (line 19): stars.*: no component stars; use"),
    "all inputs where none is left": (
        '"star.*"',
        '"star.*", "gyros.*"',
        "unconnected (line 19): gyros.*: all inputs of gyros are connected or listed already; remove this entry",
    ),
    "a parameter with a typo": (SET, SET.replace("initial", "inital"), "set.satellite.inital_quaternion: no parameter"),
    "a value of another size": (SET, SET.replace("0.99, ", ""), "3 values for 4 elements; give one value for each"),
    "a value of another type": (SET, SET.replace("0.99", "true"), "True is not of type Real; give a value of this"),
    "a value of no kind": (SET, SET.replace("0.99", '"x"'), "'x' is neither a number nor true or false"),
    "rows of another matrix": (
        SET,
        f'{SET}\n"satellite.wheel_axes" = [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]]',
        "set.satellite.wheel_axes: not 4 rows of 3 values; give one value for each element, row by row",
    ),
    "rows of a vector": (SET, SET.replace("0.99, 0.1, 0, 0.1", "[0.99, 0.1], [0, 0.1]"), "parameter is not a matrix"),
    "rows and numbers": (
        SET,
        f'{SET}\n"satellite.wheel_axes" = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], 2]',
        "not 4 rows of 3 values",
    ),
    "a step that is none": ("step = 0.125", "step = 0", "step: 0 is not a positive number of seconds; give more"),
    "a step that its FMUs refuse": ("step = 0.125", "step = 0.3", "are not a whole number of steps of 0.3 s"),
}  # fmt: skip


@pytest.fixture
def toml(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_system(tmp_path)
    return tmp_path / SHORT


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake(toml, capsys, mistake):
    before, after, line = MISTAKES[mistake]
    text = toml.read_text(encoding="utf-8")
    assert before in text
    toml.write_text(text.replace(before, after), encoding="utf-8")
    assert main(["compose", SHORT]) == 2
    printed = capsys.readouterr()
    assert line in printed.err
    assert printed.out == ""
    assert all(each.startswith("perilune: holding/") for each in printed.err.splitlines())
    assert not toml.with_name(SSD).exists()


def test_all_at_once(toml, capsys):
    text = toml.read_text(encoding="utf-8")
    for mistake in ("swapped ends", "an input that is not connected", "types that do not fit"):
        text = text.replace(*MISTAKES[mistake][:2])
    toml.write_text(text, encoding="utf-8")
    assert main(["compose", SHORT]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 3


def test_units_and_annotations(toml, capsys, refusal):
    """A unit that an annotation names is defined by its name, or by [units]; XML that does not close is refused."""
    whole = toml.read_text(encoding="utf-8").replace("[components]", 'annotations = "notes.xml"\n[components]')
    notes = (
        '<ssc:Annotation type="org.perilune.report"><Report xmlns="https://perilune.org/report">'
        '<Band title="Speed" signal="satellite.wheel_speeds[1]" low="-400" high="400" unit="UNIT" name="range"/>'
        "</Report></ssc:Annotation>"
    )
    for unit, more, status in (("rpm", "", 2), ("rpm", "[units]\nrpm = { rad = 1, s = -1, factor = 0.1047 }", 0)):
        toml.with_name("notes.xml").write_text(notes.replace("UNIT", unit), encoding="utf-8")
        toml.write_text(f"{whole}\n{more}", encoding="utf-8")
        assert main(["compose", SHORT]) == status
    assert "annotations: unit rpm is not known; define it in [units]" in capsys.readouterr().err
    ssd = toml.with_name(SSD).read_text(encoding="utf-8")
    assert '<ssc:Unit name="rpm"><ssc:BaseUnit s="-1" rad="1" factor="0.1047"/></ssc:Unit>' in ssd
    assert f"<ssd:Annotations>{notes.replace('UNIT', 'rpm')}</ssd:Annotations>" in ssd
    toml.with_name("notes.xml").write_text(notes.replace("</Report>", ""), encoding="utf-8")
    assert "not well-formed XML" in refusal(["compose", SHORT])
