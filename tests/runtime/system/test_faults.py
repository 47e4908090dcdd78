"""Faults: text form, and permitted faults of a system.

Truth: the form in docs/command_line.md, read by hand; equality of printed and parsed faults.
"""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.options.fault import KINDS, Fault, parse_fault
from perilune.analysis.runtime.system.checks import check_fault
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, pack, system

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)
NAMES = st.text("aZ_1.[], =@:'", min_size=1).filter(lambda text: text == text.strip())


@st.composite
def faults(draw):
    kind = draw(st.sampled_from(KINDS))
    value = 0.0 if kind == "freeze" else draw(NUMBERS | st.booleans())
    start = draw(NUMBERS)
    stop = draw(st.just(math.inf) | NUMBERS.filter(lambda end: end > start))
    return Fault(draw(NAMES), kind, value, start, stop)


@given(faults())
def test_what_is_printed_is_what_is_parsed(fault):
    read = parse_fault(str(fault))
    assert read == fault
    assert isinstance(read.value, bool) == isinstance(fault.value, bool)
    assert str(read) == str(fault)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("plant.jet[3]=override:0@60", Fault("plant.jet[3]", "override", 0.0, 60.0)),
        ("plant.jet[3]=override:0@60..80", Fault("plant.jet[3]", "override", 0.0, 60.0, 80.0)),
        ("gyros.rate[1]=bias:0.01@100..", Fault("gyros.rate[1]", "bias", 0.01, 100.0)),
        ("a.b.c=bias:-1e-4@.5..1.", Fault("a.b.c", "bias", -1e-4, 0.5, 1.0)),
        (" a.b = freeze @ 50 .. 70 ", Fault("a.b", "freeze", 0.0, 50.0, 70.0)),
        ("a.b=override:true@-2", Fault("a.b", "override", True, -2.0)),
    ],
)
def test_read(text, fault):
    assert parse_fault(text) == fault
    assert type(parse_fault(text).value) is type(fault.value)


def test_printed_in_few_digits():
    assert str(Fault("a.b", "bias", 0.1, 60.0, 0.1 + 60.2)) == "a.b=bias:0.1@60..60.300000000000004"
    assert str(Fault("a.b", "bias", 1e-4, 1e22)) == "a.b=bias:0.0001@1e+22"
    assert str(Fault("a.b", "override", False)) == "a.b=override:false@0"
    assert str(Fault("a.b", "freeze", start=1e9)) == "a.b=freeze@1000000000"


FORM = "COMPONENT.CONNECTOR=override|bias|freeze[:VALUE]@T[..T]"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a.b", f"not of the form {FORM}; use this form"),
        ("a.b=bias:1", f"not of the form {FORM}"),
        ("=bias:1@2", f"not of the form {FORM}"),
        ("a.b=@2", f"not of the form {FORM}"),
        ("a.b=bias:1@", f"not of the form {FORM}"),
        ("a.b=bias:1@2@3", f"not of the form {FORM}"),
        ("a.b=bias:@2", f"not of the form {FORM}"),
        ("a.b=melt:1@2", "unknown kind melt; use one of override, bias, freeze"),
        ("a.b=melt@2", "unknown kind melt"),
        ("a.b=bias@2", "bias lacks its value; write bias:VALUE"),
        ("a.b=override@2", "override lacks its value; write override:VALUE"),
        ("a.b=freeze:0@2", "a freeze has no value; omit the value"),
        ("a.b=bias:x@2", f"not a number: 'x'; write {FORM}, times in s"),
        ("a.b=bias:1@x", "not a number: 'x'"),
        ("a.b=bias:1@1..x", "not a number: 'x'"),
        ("a.b=bias:1@1...2", "not a number: '1...2'"),  # 1. to 2, or 1 to .2?
        ("a.b=bias:inf@1", "the value inf is not finite; give a finite number"),
        ("a.b=bias:nan@1", "the value nan is not finite"),
        ("a.b=bias:1@80..60", "empty window: the end, 60 s, is not after the start, 80 s; give a start before the end"),
        ("a.b=bias:1@60..60", "empty window"),
        ("a.b=bias:1@nan", "empty window"),
        ("a.b=bias:1@inf", "empty window"),
    ],
)
def test_refused_in_one_line(text, says):
    with pytest.raises(InputError) as caught:
        parse_fault(text)
    assert str(caught.value).startswith(f"faults: {text}: {says}")
    assert "\n" not in str(caught.value)


@pytest.fixture(scope="module")
def network(tiny_folder, tmp_path_factory):
    """Return a ramp that feeds a nested system with a gain, and whole numbers; nothing feeds the second gain."""
    inner = system(
        component("gain", "gain", "input u Real m; output y Real m"),
        name="inner",
        declared="input u Real m; output y Real m",
        connections=connection("u", "gain.u") + connection("gain.y", "y"),
    )
    parts = (
        component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer"),
        inner,
        component("free", "gain", "output y Real m"),
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean"),
        component("mode", "mode"),
    )
    wires = connection("ramp.y", "inner.u") + connection("ramp.flag", "whole.b") + connection("ramp.count", "whole.n")
    path = tmp_path_factory.mktemp("faults") / "s.ssp"
    pack(path, tiny_folder / "native", document(system(*parts, connections=wires)))
    return prepare_system(path).network


@pytest.mark.parametrize(
    "text",
    [
        "ramp.y=bias:0.5@1", "inner.gain.u=freeze@1", "inner.gain.y=override:-1e300@1", "ramp.flag=override:true@1",
        "whole.b=override:0@1", "ramp.flag=freeze@1", "whole.n=bias:-3@1", "ramp.count=override:2147483647@1",
        "mode.m=override:2@1",
    ],
)  # fmt: skip
def test_what_a_system_can_have(network, text):
    check_fault(network, parse_fault(text))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            "ramp.z=bias:1@1",
            "ramp.z: no component has such a connector; the nearest of 17 known names: ramp.y",
        ),
        ("ramp.start=bias:1@1", "ramp.start: a parameter that is fixed after initialisation; set it before the start"),
        ("inner.u=bias:1@1", "inner.u: no component has such a connector"),  # it is a system's: nothing happens there
        (
            "free.u=bias:1@1",
            "free.u: an input that nothing is connected to; give the input a value with set free.u=VALUE",
        ),
        ("ramp.y=override:true@1", "ramp.y: true is not of type Real; give a number"),
        ("ramp.count=override:true@1", "ramp.count: true is not of type Integer"),
        ("ramp.count=bias:0.5@1", "ramp.count: 0.5 is not of type Integer; give a whole number of 32 bits"),
        ("ramp.count=override:2147483648@1", "ramp.count: 2147483648 is not of type Integer"),
        ("mode.m=override:1.5@1", "mode.m: 1.5 is not of type Enumeration"),
        ("whole.b=override:2@1", "whole.b: 2 is not a Boolean; give true or false"),
        ("whole.b=bias:1@1", "whole.b: a Boolean has no bias; use override:true or override:false"),
    ],
)
def test_what_it_cannot(network, text, says):
    with pytest.raises(InputError) as caught:
        check_fault(network, parse_fault(text))
    assert str(caught.value).startswith(f"fault: {says}")
    assert "\n" not in str(caught.value)
