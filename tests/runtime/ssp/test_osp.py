"""OspSystemStructure.xml of the Open Simulation Platform: results equal those of libcosim for the same file.

Truth: libcosim, step by step; results by hand for initial values.
"""

import re

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.builders import fly
from tests.support.foreign.osp import groups, joined, libcosim, simulator, structure, write_osp


@pytest.fixture
def folder(tiny_folder, tmp_path):
    return lambda text, **others: write_osp(tmp_path, tiny_folder, text, **others)


CHAIN = structure(
    simulator("ramp", "ramp", start=2.0)
    + simulator("fast", "delay")
    + simulator("slow", "delay", 0.25)
    + simulator("slower", "delay", 0.5)
    + simulator("after", "delay"),
    joined("ramp.y", "fast.u")
    + joined("slow.u", "fast.y")
    + joined("slow.y", "slower.u")
    + joined("slower.y", "after.u"),
)


def test_steps_of_their_own(folder):
    written = folder(CHAIN)
    result = fly(written, stop_time=3.0)
    names = ["ramp.y", "fast.y", "slow.y", "slower.y", "after.y"]
    truth = libcosim(written, names, 24)
    for column, (name, period) in enumerate(zip(names, (1, 1, 2, 4, 1), strict=True)):
        ours = result[name][1:]
        # libcosim shows what a slow simulator holds at once, and hands it on at the end of its step
        np.testing.assert_array_equal(ours[period - 1 :: period], truth[period - 1 :: period, column], err_msg=name)


def test_steps_that_seldom_meet(folder):
    """Steps of 2 and 3 base steps: the newest value that is there counts (libcosim waits for every sixth step)."""
    written = folder(CHAIN.replace('stepSize="0.5"', 'stepSize="0.375"'))
    result = fly(written, stop_time=3.0)
    read = result["slow.y"][[0, 3, 6, 9, 12, 15, 18, 21]]
    np.testing.assert_array_equal(result["slower.y"][3::3], read)


def test_a_step_size_of_zero_is_no_hint(folder):
    written = folder(CHAIN.replace('stepSize="0.25"', 'stepSize="0.0"'))
    truth = libcosim(written, ["slow.y"], 12)
    np.testing.assert_array_equal(fly(written, stop_time=1.5)["slow.y"][1:], truth[:, 0])


@pytest.mark.parametrize("step", ["-0.25", "soon", "nan"])
def test_a_bad_step_size_is_named(folder, step):
    words = rf'Simulator slow \(line 5\): stepSize {step!r} is not a positive number of seconds; write stepSize="0\.1"'
    with pytest.raises(InputError, match=words):
        fly(folder(CHAIN.replace('stepSize="0.25"', f'stepSize="{step}"')))


def test_a_step_that_is_no_multiple(folder, capsys):
    written = folder(structure(simulator("ramp", "ramp", 0.3) + simulator("fast", "delay"), joined("ramp.y", "fast.u")))
    truth = libcosim(written, ["fast.y"], 12)
    np.testing.assert_array_equal(fly(written, stop_time=1.5)["fast.y"][1:], truth[:, 0])
    assert main(["validate", str(written), "--stop-time", "1"]) == 0
    assert "ramp: steps by 0.25 s, not by the requested 0.3 s" in " ".join(capsys.readouterr().out.split())


def test_the_file_itself_may_be_named(folder):
    written = folder(CHAIN)
    actual = [fly(path, stop_time=1.5)["after.y"] for path in (written, written / "OspSystemStructure.xml")]
    np.testing.assert_array_equal(*actual)


def test_fmus_far_above_the_file(tiny_folder, tmp_path, capsys):
    """As libcosim takes them; each is named in a note."""
    text = re.sub(r'"(\w+\.fmu)"', r'"../../../\1"', CHAIN)
    written = write_osp(tmp_path / "a" / "b" / "c", tiny_folder, text, fmus="../../..")
    truth = libcosim(written, ["after.y"], 12)[:, 0]
    np.testing.assert_array_equal(fly(written / "OspSystemStructure.xml", stop_time=1.5)["after.y"][1:], truth)
    assert main(["validate", str(written)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert f"reads {tmp_path / 'ramp.fmu'}, {tmp_path / 'delay.fmu'}, which lie outside the system's folder" in said


def test_simulators_in_a_process_of_their_own(folder):
    actual = []
    for source in ("delay.fmu", "proxyfmu://localhost?file=delay.fmu"):
        actual.append(fly(folder(CHAIN.replace('"delay.fmu"', f'"{source}"')), stop_time=1.5)["after.y"])
    np.testing.assert_array_equal(*actual)
    text = CHAIN.replace('"ramp.fmu"', '"proxyfmu://lab:9090?file=ramp.fmu"')
    with pytest.raises(InputError, match=r"source proxyfmu://lab:9090\?file=ramp\.fmu of ramp is in another process"):
        fly(folder(text))


def test_a_file_of_another_name(folder):
    """It is read by its own name; its folder then has no description of the platform's name."""
    written = folder(CHAIN)
    expected = fly(written, stop_time=1.5)["after.y"]
    other = (written / "OspSystemStructure.xml").rename(written / "Chain.xml")
    np.testing.assert_array_equal(fly(other, stop_time=1.5)["after.y"], expected)
    with pytest.raises(InputError, match=r"not found; .* or such a file by its name"):
        fly(written)


def test_what_has_no_effect_in_fixed_steps_is_noted(folder, capsys):
    """The configuration of ECCO and its bonds, as libcosim, which joins the variables and no more."""
    bond = CHAIN.replace("<VariableConnection>", '<VariableConnection powerBond="b">', 1)
    text = bond.replace("</OspSystemStructure>", "<EccoConfiguration/></OspSystemStructure>")
    assert text.count("EccoConfiguration") == text.count("powerBond") == 1
    actual = fly(folder(text), stop_time=1.5)["after.y"]
    np.testing.assert_array_equal(actual, fly(folder(CHAIN), stop_time=1.5)["after.y"])
    assert main(["validate", str(folder(text)), "--stop-time", "1"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "without effect in the algorithm fixedStep" in said
    assert "powerBond b (line" in said


def test_validate_needs_no_end(folder, capsys, refusal):
    """EndTime is optional; `run` cannot do without."""
    written = folder(CHAIN)
    assert main(["validate", str(written)]) == 0
    assert "EndTime is missing, so run needs --stop-time" in " ".join(capsys.readouterr().out.split())
    assert "EndTime: missing; give --stop-time" in refusal(["run", str(written)])


def test_an_end_of_its_own(folder):
    written = folder(CHAIN.replace("<BaseStepSize>", "<StartTime>1</StartTime><EndTime>2.5</EndTime><BaseStepSize>"))
    result = fly(written)
    assert (result.time[0], result.time[-1]) == (1.0, 2.5)
    np.testing.assert_array_equal(result["after.y"], fly(folder(CHAIN), stop_time=1.5)["after.y"])


def test_groups_of_variables(folder):
    wires = joined("one.port", "other.plug", "VariableGroup") + joined("ramp.y", "one.a")
    text = structure(simulator("ramp", "ramp") + simulator("one", "cross") + simulator("other", "gain"), wires)
    written = folder(text, cross_OspModelDescription=groups(port="ya"), gain_OspModelDescription=groups(plug="u"))
    result = fly(written, stop_time=1)
    np.testing.assert_array_equal(result["other.u"], result["one.ya"])
    assert np.ptp(result["other.y"]) > 0.0
    description = written / "gain_OspModelDescription.xml"
    description.write_text(groups(plug="u").replace("ref=", "name="))
    with pytest.raises(InputError, match=r"gain_OspModelDescription\.xml: Variable \(line \d+\): has no ref"):
        fly(written, stop_time=1)
    description.unlink()
    with pytest.raises(InputError, match=r"VariableGroup \(line \d+\): no file gain_OspModelDescription\.xml"):
        fly(written, stop_time=1)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<a/>", "a is not an OspSystemStructure"),
        (
            CHAIN.replace("ramp.fmu", "proxyfmu://here"),
            r"Simulator \(line 5\): source proxyfmu://here of ramp is in another process or machine",
        ),
        (
            CHAIN.replace('simulator="fast"', 'simulator="vast"'),
            r"Variable \(line \d+\): no simulator vast; name one of",
        ),
        (
            CHAIN.replace(">0.125<", ">ten<"),
            r"BaseStepSize \(line 2\): content 'ten' is not a positive number of seconds; write a number such as 0\.1",
        ),
        (CHAIN.replace("fixedStep", "ecco"), r"ecco is not supported"),
        (
            CHAIN.replace("<Connections>", "<VariableConnections/><Connections>"),
            r"VariableConnections \(line \d+\): is not part of an OspSystemStructure 0\.1",
        ),
        (
            CHAIN.replace("<Simulators>", '<Functions><Product name="s"/></Functions><Simulators>'),
            "replace the function by an FMU",
        ),
        (CHAIN.replace('name="y"', 'name="why"', 1), r"ramp\.why \(line 8\): .* has no variable of this name"),
        (CHAIN.replace('variable="start"', 'variable="stort"'), r"stort .*matches no parameter.*start"),
    ],
)
def test_refusals(folder, text, words):
    with pytest.raises(InputError, match=words):
        fly(folder(text), stop_time=1)


@pytest.mark.parametrize("location", ["config", "fmus"])
def test_a_folder_for_the_description_and_one_for_fmus(tiny_folder, tmp_path, location):
    """As the platform's demonstrations are: config/ next to fmus/; descriptions of groups in the one or the other."""
    wires = joined("one.port", "other.plug", "VariableGroup") + joined("ramp.y", "one.a")
    text = structure(
        simulator("ramp", "../fmus/ramp") + simulator("one", "../fmus/cross") + simulator("other", "../fmus/gain"),
        wires,
    )
    config = write_osp(tmp_path / "config", tiny_folder, text, "../fmus")
    for name, content in (("cross", groups(port="ya")), ("gain", groups(plug="u"))):
        (tmp_path / location / f"{name}_OspModelDescription.xml").write_text(content)
    result = fly(config, stop_time=2)
    np.testing.assert_array_equal(result["other.y"][1:], libcosim(config, ["other.y"], 16)[:, 0])


def test_groups_go_by_the_name_of_the_model(tiny_folder, tmp_path):
    """An FMU's file may have another name."""
    wires = joined("one.port", "other.plug", "VariableGroup") + joined("ramp.y", "one.a")
    text = structure(simulator("ramp", "ramp") + simulator("one", "renamed") + simulator("other", "gain"), wires)
    descriptions = {"cross_OspModelDescription": groups(port="ya"), "gain_OspModelDescription": groups(plug="u")}
    config = write_osp(tmp_path, tiny_folder, text, **descriptions)
    (config / "cross.fmu").rename(config / "renamed.fmu")
    result = fly(config, stop_time=2)
    np.testing.assert_array_equal(result["other.y"][1:], libcosim(config, ["other.y"], 16)[:, 0])
