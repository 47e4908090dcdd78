"""Functions of an OspSystemStructure.xml: gains and sums.

Truth: libcosim, which reads the same file; the sums, computed here.
"""

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.analysis.options.fault import parse_fault
from perilune.common.errors import InputError
from tests.support.builders import fly
from tests.support.foreign.osp import groups, joined, libcosim, simulator, structure, write_osp


@pytest.fixture
def folder(tiny_folder, tmp_path):
    return lambda text, **others: write_osp(tmp_path, tiny_folder, text, **others)


def variable(name, kind="Variable"):
    owner, _, variable_name = name.partition(".")
    return f'<{kind} simulator="{owner}" name="{variable_name}"/>'


def signal(start, end, group=""):
    """Return a connection between a variable and a signal of a function, ``f:in`` or ``f:out``, in this order."""
    ends = [
        '<Signal{} function="{}" name="{}"/>'.format(group, *end.split(":"))
        if ":" in end
        else variable(end, f"Variable{group}")
        for end in (start, end)
    ]
    return f"<Signal{group}Connection>{''.join(ends)}</Signal{group}Connection>"


def functions(*lines):
    return f"<Functions>{''.join(lines)}</Functions>\n"


RAMPS = simulator("ramp", "ramp", start=2.0) + simulator("other", "ramp", slope=-3.0) + simulator("fast", "delay")


def test_a_gain(folder):
    text = structure(
        RAMPS,
        signal("ramp.y", "f:in") + signal("f:out", "fast.u"),
        functions('<LinearTransformation name="f" factor="2" offset="-1"/>'),
    )
    path = folder(text)
    result = fly(path, stop_time=1)
    np.testing.assert_array_equal(result["fast.u"], 2.0 * result["ramp.y"] - 1.0)
    np.testing.assert_array_equal(result["fast.y"][1:], libcosim(path, ["fast.y"], 8)[:, 0])


def test_a_sum(folder):
    """A sum of three outputs, one of which is connected to something else too, and one repeated."""
    text = structure(
        RAMPS + simulator("slow", "delay", 0.25),
        signal("ramp.y", "s:in[0]")
        + signal("other.y", "s:in[2]")
        + signal("s:out", "fast.u")
        + signal("s:in[1]", "ramp.y")
        + joined("ramp.y", "slow.u"),
        functions('<Sum name="s" inputCount="3"/>'),
    )
    path = folder(text)
    result = fly(path, stop_time=2)
    np.testing.assert_array_equal(result["fast.u"], result["ramp.y"] + result["ramp.y"] + result["other.y"])
    np.testing.assert_array_equal(result["fast.y"][1:], libcosim(path, ["fast.y"], 16)[:, 0])
    np.testing.assert_array_equal(result["slow.u"][::2], result["ramp.y"][::2])


def test_a_sum_waits_for_all_that_it_adds(folder):
    """A gain behind a sum of a gain and a source has at the start what the closed form says."""
    text = structure(
        simulator("after", "gain", factor=2.0)
        + simulator("before", "gain", factor=5.0)
        + simulator("ramp", "ramp", start=3.0),
        joined("ramp.y", "before.u") + signal("before.y", "s:in[0]") + signal("ramp.y", "s:in[1]")
        + signal("s:out", "after.u"),
        functions('<Sum name="s" inputCount="2"/>'),
    )  # fmt: skip
    result = fly(folder(text), stop_time=1, algorithm="sequential")
    np.testing.assert_array_equal(result["after.y"], 2.0 * (5.0 * result["ramp.y"] + result["ramp.y"]))


def test_a_sum_of_vectors(folder):
    text = structure(
        RAMPS + simulator("one", "cross") + simulator("two", "cross") + simulator("sum", "cross"),
        joined("ramp.y", "one.a") + joined("other.y", "two.b") + joined("other.y", "one.b") + joined("ramp.y", "two.a")
        + signal("one.port", "v:in[0]", "Group") + signal("two.port", "v:in[1]", "Group")
        + signal("v:out", "sum.plug", "Group"),
        functions('<VectorSum name="v" inputCount="2" dimension="2"/>'),
    )  # fmt: skip
    path = folder(text, cross_OspModelDescription=groups(port="ya yb", plug="a b"))
    result = fly(path, stop_time=2)
    for element in "ab":
        expected = result[f"one.y{element}"] + result[f"two.y{element}"]
        np.testing.assert_array_equal(result[f"sum.{element}"], expected)
    names = ["sum.ya", "sum.yb"]
    np.testing.assert_array_equal(np.column_stack([result[name][1:] for name in names]), libcosim(path, names, 16))


def test_a_fault_acts_on_the_sum(folder):
    text = structure(
        RAMPS,
        signal("ramp.y", "s:in[0]") + signal("other.y", "s:in[1]") + signal("s:out", "fast.u"),
        functions('<Sum name="s" inputCount="2"/>'),
    )
    result = fly(folder(text), stop_time=1, faults=[parse_fault("fast.u=bias:10@0")])
    np.testing.assert_array_equal(result["fast.u"], result["ramp.y"] + result["other.y"] + 10.0)


def counter(name, first):
    value = f'<InitialValue variable="first_count"><Integer value="{first}"/></InitialValue>'
    return f'<Simulator name="{name}" source="ramp.fmu"><InitialValues>{value}</InitialValues></Simulator>'


@pytest.mark.parametrize(("first", "row"), [(5, None), (2**30 - 4, 4)])
def test_a_sum_of_integers_has_32_bits(folder, capsys, first, row):
    text = structure(
        counter("a", first) + counter("b", first) + simulator("whole", "whole"),
        signal("a.count", "s:in[0]") + signal("b.count", "s:in[1]") + signal("s:out", "whole.n"),
        functions('<Sum name="s" inputCount="2"/>'),
    )
    path = folder(text)
    if row is None:
        result = fly(path, stop_time=1)
        np.testing.assert_array_equal(result["whole.n"], 2 * (first + np.arange(9)))
    else:
        assert main(["run", str(path), "--stop-time", "1"]) == 1
        said = " ".join(capsys.readouterr().err.split())
        assert f"whole.n is {2.0**31}, beyond the 32 bits of an Integer, at t = {row * 0.125:g} s" in said


def of_sum(*wires, inputs=2):
    return structure(RAMPS, "".join(wires), functions(f'<Sum name="s" inputCount="{inputs}"/>'))


BOTH = signal("ramp.y", "s:in[0]") + signal("other.y", "s:in[1]")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (of_sum(signal("ramp.y", "s:in[0]"), signal("s:out", "fast.u")), r"nothing is connected to in\[1\] of s"),
        (of_sum(BOTH, signal("ramp.y", "s:in[2]")), r"s has no signal in\[2\]; use in\[0\], in\[1\] or out"),
        (of_sum(BOTH, signal("ramp.y", "s:in[1]")), r"a second connection to in\[1\] of s"),
        (of_sum(BOTH, signal("ramp.y", "t:in[1]")), "no function t; name one of s"),
        (of_sum(BOTH, signal("s:out", "fast.y")), r"fast\.y .*output"),
        (
            of_sum(signal("fast.u", "s:in[0]"), signal("fast.u", "s:in[1]"), signal("s:out", "ramp.y")),
            "cannot be a term of a sum",
        ),
        (of_sum(BOTH, inputs="many"), "inputCount 'many' is not a number from 1 to 10000"),
        (of_sum(BOTH, signal("ramp.flag", "s:out")), r"flag"),
        (
            structure(RAMPS, signal("ramp.y", "v:in[0]"), functions('<VectorSum name="v" dimension="3"/>')),
            "a signal of v has 3 elements, not 1",
        ),
        (structure(RAMPS, "", functions('<LinearTransformation name="f" factor="x"/>')), "factor 'x' is not a number"),
        (
            structure(RAMPS, "", functions('<Sum name="s"/>', '<Sum name="s"/>')),
            r"Sum \(line \d+\): a second function named",
        ),
    ],
)
def test_refusals(folder, text, words):
    with pytest.raises(InputError, match=words):
        fly(folder(text), stop_time=1, open_inputs="start")
