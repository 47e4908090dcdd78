"""OspSystemStructure.xml of the Open Simulation Platform flies here as in libcosim, which reads the same file.

Truth: libcosim, step by step; pencil and paper for what it makes of a start.
"""

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.analysis.common.errors import InputError
from tests.support.builders import fly

HEAD = '<OspSystemStructure xmlns="http://opensimulationplatform.com/MSMI/OSPSystemStructure" version="0.1">'


def structure(simulators, connections, more=""):
    return (
        f"{HEAD}\n<BaseStepSize>0.125</BaseStepSize>\n<Algorithm>fixedStep</Algorithm>\n{more}<Simulators>\n{simulators}\n</Simulators>\n"
        f"<Connections>\n{connections}\n</Connections>\n</OspSystemStructure>\n"
    )


def simulator(name, fmu, step=None, **values):
    inside = "".join(
        f'<InitialValue variable="{variable}"><Real value="{value}"/></InitialValue>'
        for variable, value in values.items()
    )
    attribute = "" if step is None else f' stepSize="{step}"'
    return f'<Simulator name="{name}" source="{fmu}.fmu"{attribute}><InitialValues>{inside}</InitialValues></Simulator>'


def joined(start, end, kind="Variable"):
    inside = "".join(
        f'<{kind} simulator="{simulator}" name="{name}"/>'
        for simulator, _, name in (p.partition(".") for p in (start, end))
    )
    return f"<{kind}Connection>{inside}</{kind}Connection>"


@pytest.fixture
def folder(tiny_folder, tmp_path):
    """A folder as libcosim takes it: FMUs beside the file."""

    def make(text, **others):
        for name in ("ramp", "gain", "delay", "cross"):
            (tmp_path / f"{name}.fmu").write_bytes((tiny_folder / "native" / f"{name}.fmu").read_bytes())
        (tmp_path / "OspSystemStructure.xml").write_text(text)
        for name, content in others.items():
            (tmp_path / f"{name}.xml").write_text(content)
        return tmp_path

    return make


def libcosim(folder, outputs, steps):
    """Values [steps, outputs] after each base step."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    execution = CosimExecution.from_osp_config_file(str(folder / "OspSystemStructure.xml"))
    observer = CosimObserver.create_last_value()
    assert execution.add_observer(observer)
    actual = []
    for _ in range(steps):
        assert execution.step(1)
        row = []
        for name in outputs:
            owner, _, variable = name.partition(".")
            index = execution.slave_index_from_instance_name(owner)
            references = {item.name.decode(): item.reference for item in execution.slave_variables(index)}
            row += observer.last_real_values(index, [references[variable]])
        actual.append(row)
    return np.array(actual)


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
    place = folder(CHAIN)
    result = fly(place, stop_time=3.0)
    names = ["ramp.y", "fast.y", "slow.y", "slower.y", "after.y"]
    truth = libcosim(place, names, 24)
    for column, (name, period) in enumerate(zip(names, (1, 1, 2, 4, 1), strict=True)):
        ours = result[name][1:]
        # libcosim shows what a slow simulator holds at once, and hands it on at the end of its step
        np.testing.assert_array_equal(ours[period - 1 :: period], truth[period - 1 :: period, column], err_msg=name)


def test_steps_that_seldom_meet(folder):
    """Steps of 2 and 3 base steps: the newest value that is there counts (libcosim waits for every sixth step)."""
    place = folder(CHAIN.replace('stepSize="0.5"', 'stepSize="0.375"'))
    result = fly(place, stop_time=3.0)
    read = result["slow.y"][[0, 3, 6, 9, 12, 15, 18, 21]]
    np.testing.assert_array_equal(result["slower.y"][3::3], read)


def test_a_step_that_is_no_multiple(folder, capsys):
    place = folder(structure(simulator("ramp", "ramp", 0.3) + simulator("fast", "delay"), joined("ramp.y", "fast.u")))
    truth = libcosim(place, ["fast.y"], 12)
    np.testing.assert_array_equal(fly(place, stop_time=1.5)["fast.y"][1:], truth[:, 0])
    assert main(["validate", str(place), "--stop-time", "1"]) == 0
    assert "ramp: steps by 0.25 s, not by 0.3 s as it asks" in " ".join(capsys.readouterr().out.split())


def test_the_file_itself_may_be_named(folder):
    place = folder(CHAIN)
    actual = [fly(path, stop_time=1.5)["after.y"] for path in (place, place / "OspSystemStructure.xml")]
    np.testing.assert_array_equal(*actual)


def test_simulators_in_a_process_of_their_own(folder):
    actual = []
    for source in ("delay.fmu", "proxyfmu://localhost?file=delay.fmu"):
        actual.append(fly(folder(CHAIN.replace('"delay.fmu"', f'"{source}"')), stop_time=1.5)["after.y"])
    np.testing.assert_array_equal(*actual)
    text = CHAIN.replace('"ramp.fmu"', '"proxyfmu://lab:9090?file=ramp.fmu"')
    with pytest.raises(InputError, match=r"source proxyfmu://lab:9090\?file=ramp\.fmu of ramp is on another machine"):
        fly(folder(text))


def test_an_end_of_its_own(folder):
    place = folder(CHAIN.replace("<BaseStepSize>", "<StartTime>1</StartTime><EndTime>2.5</EndTime><BaseStepSize>"))
    result = fly(place)
    assert (result.time[0], result.time[-1]) == (1.0, 2.5)
    np.testing.assert_array_equal(result["after.y"], fly(folder(CHAIN), stop_time=1.5)["after.y"])


def test_linear_functions(folder):
    function = '<Functions><LinearTransformation name="f" factor="2" offset="-1"/></Functions>\n'
    wires = (
        '<SignalConnection><Variable simulator="ramp" name="y"/><Signal function="f" name="in"/></SignalConnection>'
        '<SignalConnection><Signal function="f" name="out"/><Variable simulator="fast" name="u"/></SignalConnection>'
    )
    result = fly(
        folder(structure(simulator("ramp", "ramp") + simulator("fast", "delay"), wires, function)), stop_time=1
    )
    np.testing.assert_array_equal(result["fast.u"], 2.0 * result["ramp.y"] - 1.0)


def test_groups_of_variables(folder):
    groups = (
        '<OspModelDescription xmlns="http://opensimulationplatform.com/MSMI/OSPModelDescription" version="1.0">'
        '<VariableGroups><Generic name="{}">{}</Generic></VariableGroups></OspModelDescription>'
    )
    wires = joined("one.port", "other.plug", "VariableGroup") + joined("ramp.y", "one.a")
    text = structure(simulator("ramp", "ramp") + simulator("one", "cross") + simulator("other", "gain"), wires)
    place = folder(
        text,
        cross_OspModelDescription=groups.format("port", '<Variable ref="ya"/>'),
        gain_OspModelDescription=groups.format("plug", '<Variable ref="u"/>'),
    )
    result = fly(place, stop_time=1)
    np.testing.assert_array_equal(result["other.u"], result["one.ya"])
    assert np.ptp(result["other.y"]) > 0.0
    (place / "gain_OspModelDescription.xml").unlink()
    with pytest.raises(InputError, match=r"VariableGroup \(line \d+\): no file gain_OspModelDescription\.xml"):
        fly(place, stop_time=1)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<a/>", "a is not an OspSystemStructure"),
        (CHAIN.replace("ramp.fmu", "proxyfmu://here"), r"Simulator \(line 5\): source proxyfmu.* is not an \.fmu"),
        (
            CHAIN.replace('simulator="fast"', 'simulator="vast"'),
            r"Variable \(line \d+\): no simulator vast; name one of",
        ),
        (CHAIN.replace(">0.125<", ">ten<"), r"BaseStepSize is not a positive number of seconds"),
        (CHAIN.replace("fixedStep", "ecco"), r"ecco is not flown here"),
        (
            CHAIN.replace("<Simulators>", '<Functions><Sum name="s"/></Functions><Simulators>'),
            "use an FMU that does it",
        ),
        (CHAIN.replace('name="y"', 'name="why"', 1), r"ramp\.why \(line 8\): .* has no variable of this name"),
        (CHAIN.replace('variable="start"', 'variable="stort"'), r"stort .*matches no parameter.*start"),
    ],
)
def test_refusals(folder, text, words):
    with pytest.raises(InputError, match=words):
        fly(folder(text), stop_time=1)
