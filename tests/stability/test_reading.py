"""Declared stability of a system, and errors in it, each in one line that names the place.

Truth: the declaration as written, and the line number of the wrong element.
"""

import pytest

import perilune
from perilune.analysis.runtime.ssp.ssd_reader import Reader
from perilune.analysis.runtime.system.options import Layer
from perilune.analysis.stability.request.declaration import (
    Declaration,
    LoopDeclaration,
    MarginLimits,
    NonlinearElement,
    PointDeclaration,
    Sweep,
)
from perilune.analysis.stability.request.loop_declaration import read_declaration
from perilune.common.errors import InputError
from tests.support.builders import component, document, pack, system
from tests.support.loops.exact_systems import ring, with_stability

SSD = document(system(component("plant", "held_mass", "input u Real; output position Real")))
POINT = '<Point name="hold" time="20"/>'
LOOP = '<Loop name="one" cut="plant.position" points="hold"/>'


def read(*lines):
    text = with_stability(SSD, "\n".join(lines))
    return text, read_declaration(Reader("x.ssp/SystemStructure.ssd", lambda *_: b"").read(text.encode()))


def test_nothing_is_declared():
    description = Reader("x.ssd", lambda *_: b"").read(SSD.encode())
    assert read_declaration(description) == Declaration()
    assert Declaration().limits == MarginLimits(6.0, 30.0, 0.5, 3.0, 20.0)


def test_all_that_can_be_declared():
    _, actual = read(
        '<Limits gain_margin_db="8" phase_margin_deg="40"/>',
        '<Limits modulus_margin="0.6" dispersed_gain_margin_db="4" dispersed_phase_margin_deg="25"/>',
        "<!-- a comment -->",
        '<Point name="hold" time="20" until="4000" phase="waits">',
        '<Use component="jets" fmu="f"/><ParameterSet source="a.ssv"/><ParameterSet source="b.ssv"/>',
        '<Set name="plant.start" value="2"/></Point>',
        '<Point name="near" signal="plant.position" falls_to="-1e1"/>',
        '<Loop name="one" cut="plant.u" points=" near  hold " period="0.5" amplitude="0.01" returned="plant.position">',
        '<Element name="jets" kind="relay" level="0.06" dead_zone="0.02"><Use component="jets" fmu="r"/></Element>',
        '<Element name="steps" kind="quantiser" step="0.1"/></Loop>',
        '<Loop name="thrust" cut="plant.u" direction="plant.v" points="near"/>',
        '<Sweep name="s" loop="one" point="hold" parameter="plant.start" low="-1" high="10"/>',
    )
    hold = PointDeclaration(
        "hold",
        time=20.0,
        until=4000.0,
        phase="waits",
        layer=Layer(use={"jets": "f"}, parameters=("a.ssv", "b.ssv"), set={"plant.start": "2"}),
    )
    elements = (
        NonlinearElement("jets", "relay", {"level": 0.06, "dead_zone": 0.02}, Layer(use={"jets": "r"})),
        NonlinearElement("steps", "quantiser", {"step": 0.1}),
    )
    one = LoopDeclaration(
        "one", "plant.u", ("near", "hold"), returned="plant.position", period=0.5, amplitude=0.01, elements=elements
    )
    assert actual == Declaration(
        limits=MarginLimits(8.0, 40.0, 0.6, 4.0, 25.0),
        points=(hold, PointDeclaration("near", signal="plant.position", falls_to=-10.0)),
        loops=(one, LoopDeclaration("thrust", "plant.u", ("near",), direction="plant.v")),
        sweeps=(Sweep("s", "one", "hold", "plant.start", -1.0, 10.0),),
    )


WRONG = {
    # what the wrong element is, by its line; words of the message
    "unknown element": ("<Pint/>", "Pint", "unknown element; use one of Point, Limits, Loop, Sweep"),
    "unknown attribute of limits": ('<Limits gain="8"/>', "Limits", "unknown attribute gain"),
    "limit that is no number": (
        '<Limits gain_margin_db="6 dB"/>',
        "Limits",
        "gain_margin_db '6 dB' is not a positive number",
    ),
    "limit of 0": ('<Limits modulus_margin="0"/>', "Limits", "modulus_margin '0' is not a positive number"),
    "negative limit": ('<Limits phase_margin_deg="-30"/>', "Limits", "phase_margin_deg '-30' is not a positive number"),
    "point without a name": ('<Point time="1"/>', "Point", "no name"),
    "point with an empty name": ('<Point name=" " time="1"/>', "Point", "no name"),
    "point without a time": ('<Point name="p"/>', "Point", "needs either a time, or a signal"),
    "point with both": ('<Point name="p" time="1" signal="a.b" falls_to="1"/>', "Point", "give one of the two"),
    "point with half a signal": ('<Point name="p" signal="a.b"/>', "Point", "falls_to"),
    "time that is no number": ('<Point name="p" time="soon"/>', "Point", "time 'soon' is not a number"),
    "time that is not finite": ('<Point name="p" time="inf"/>', "Point", "time 'inf' is not a number"),
    "unknown attribute of a point": ('<Point name="p" tine="1" time="1"/>', "Point", "unknown attribute tine"),
    "a point's name twice": ('<Point name="hold" time="1"/>', "Point", "the name hold occurs twice"),
    "unknown part of a point": ('<Point name="p" time="1"><Let/></Point>', "Let", "unknown element"),
    "use without an fmu": ('<Point name="p" time="1"><Use component="c"/></Point>', "Use", "no fmu"),
    "set twice": (
        '<Point name="p" time="1"><Set name="c.p" value="1"/><Set name="c.p" value="2"/></Point>',
        "Set",
        "c.p is given twice",
    ),
    "use twice": (
        '<Point name="p" time="1"><Use component="c" fmu="f"/><Use component="c" fmu="g"/></Point>',
        "Use",
        "c is given twice",
    ),
    "point that ends before it is there": (
        '<Point name="p" time="20" until="10"/>',
        "Point",
        "until = 10 s is not after time = 20 s",
    ),
    "point that lasts no time": (
        '<Point name="p" time="20" until="20"/>',
        "Point",
        "until = 20 s is not after time = 20 s",
    ),
    "set without a value": ('<Point name="p" time="1"><Set name="c.p"/></Point>', "Set", "no value"),
    "parameter set without a source": ('<Point name="p" time="1"><ParameterSet/></Point>', "ParameterSet", "no source"),
    "loop without a cut": ('<Loop name="l" points="hold"/>', "Loop", "no cut"),
    "loop without points": ('<Loop name="l" cut="a.b"/>', "Loop", "no points"),
    "loop at an unknown point": ('<Loop name="l" cut="a.b" points="hold hodl"/>', "Loop", "no point hodl; use one of"),
    "loop at a point twice": ('<Loop name="l" cut="a.b" points="hold hold"/>', "Loop", "a point is given twice"),
    "direction's rate without the time ahead": (
        '<Loop name="l" cut="a.b" direction="a.d" direction_rate="a.r" points="hold"/>',
        "Loop",
        "direction_rate and ahead must be given together",
    ),
    "time ahead without a direction's rate": (
        '<Loop name="l" cut="a.b" direction="a.d" ahead="0.1" points="hold"/>',
        "Loop",
        "direction_rate and ahead must be given together",
    ),
    "direction's rate without a direction": (
        '<Loop name="l" cut="a.b" direction_rate="a.r" ahead="0.1" points="hold"/>',
        "Loop",
        "direction_rate and ahead must be given together, and with a direction",
    ),
    "unknown attribute of a loop": ('<Loop name="l" cut="a.b" points="hold" perod="1"/>', "Loop", "attribute perod"),
    "period of 0": ('<Loop name="l" cut="a.b" points="hold" period="0"/>', "Loop", "period '0' is not a positive"),
    "negative amplitude": ('<Loop name="l" cut="a.b" points="hold" amplitude="-1"/>', "Loop", "amplitude '-1' is not"),
    "a loop's name twice": ('<Loop name="one" cut="a.b" points="hold"/>', "Loop", "the name one occurs twice"),
    "unknown part of a loop": ('<Loop name="l" cut="a.b" points="hold"><Use/></Loop>', "Use", "unknown element"),
    "sweep of an unknown loop": (
        '<Sweep name="s" loop="two" point="hold" parameter="c.p" low="1" high="2"/>',
        "Sweep",
        "no such loop",
    ),
    "sweep at a point that is not the loop's": (
        '<Sweep name="s" loop="one" point="p" parameter="c.p" low="1" high="2"/>',
        "Sweep",
        "no such loop at this point",
    ),
    "sweep without a parameter": (
        '<Sweep name="s" loop="one" point="hold" low="1" high="2"/>',
        "Sweep",
        "no parameter",
    ),
    "sweep from high to low": (
        '<Sweep name="s" loop="one" point="hold" parameter="c.p" low="2" high="1"/>',
        "Sweep",
        "is not below high",
    ),
    "bound that is no number": (
        '<Sweep name="s" loop="one" point="hold" parameter="c.p" low="a" high="1"/>',
        "Sweep",
        "low 'a' is not a number",
    ),
}
WRONG_ELEMENTS = {
    "unknown kind": ('name="e" kind="relais" level="1"', "unknown kind 'relais'"),
    "no kind": ('name="e" level="1"', "kind"),
    "no name": ('kind="relay" level="1"', "no name"),
    "parameter that is no number": ('name="e" kind="relay" level="high"', "level 'high' is not a number"),
    "unknown parameter": ('name="e" kind="relay" level="1" deadzone="1"', "no parameter 'deadzone'"),
    "missing parameter": ('name="e" kind="relay" dead_zone="1"', "lacks its parameter 'level'"),
    "negative parameter": ('name="e" kind="relay" level="1" dead_zone="-1"', "is negative"),
    "impossible parameters": ('name="e" kind="pulse width" level="1" dead_zone="2"', "dead_zone = 2"),
}


def assert_refused(lines, bad, element, words):
    text = with_stability(SSD, "\n".join(lines))
    line = text[: text.index(bad)].count("\n") + 1
    with pytest.raises(InputError) as caught:
        read(*lines)
    message = str(caught.value)
    assert message.startswith(f"x.ssp/SystemStructure.ssd: {element} (line {line}): ")
    assert words in message
    assert "\n" not in message


@pytest.mark.parametrize("name", WRONG)
def test_everything_wrong_is_refused_with_its_line(name):
    bad, element, words = WRONG[name]
    assert_refused([POINT, LOOP, bad], bad, element, words)


@pytest.mark.parametrize("name", WRONG_ELEMENTS)
def test_a_wrong_nonlinear_element_is_refused_with_its_line(name):
    attributes, words = WRONG_ELEMENTS[name]
    bad = f"<Element {attributes}/>"
    assert_refused([POINT, '<Loop name="l" cut="a.b" points="hold">', bad, "</Loop>"], bad, "Element", words)


def test_the_annotation_holds_just_one_declaration():
    for wrong in ("", "<Stabilty/>", '<Stability xmlns="https://perilune.org/stability"/>' * 2):
        text = with_stability(SSD, "@")
        begin, end = text.index("<Stability"), text.index("</Stability>") + len("</Stability>")
        with pytest.raises(InputError, match=r"line \d+") as caught:
            read_declaration(Reader("x.ssd", lambda *_: b"").read((text[:begin] + wrong + text[end:]).encode()))
        assert str(caught.value).startswith("x.ssd: ")
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("point", "loop", "words"),
    [
        ('time="0"', 'cut="plant.nothing"', r"loop one: no connector plant\.nothing"),
        ('time="0"', 'cut="plant.u" returned="plant.nothing"', r"loop one: no connector plant\.nothing"),
        ('time="0"', 'cut="plant.u" period="0.3"', "loop one: period 0.3 s is not a whole number"),
        ('signal="plant.nothing" falls_to="1"', 'cut="plant.u"', r"point hold: no signal plant\.nothing"),
    ],
)
def test_what_only_the_system_can_tell_is_refused_too(exact_fmus, tmp_path, point, loop, words):
    declared = f'<Point name="hold" {point}/>\n<Loop name="one" {loop} points="hold"/>'
    parts = {"control": ("difference", "u", "y", ""), "plant": ("held_mass", "u", "position", "")}
    ssd = ring(parts, 0.25, 10.0, declared)
    with pytest.raises(InputError, match=words) as caught:
        perilune.stability(pack(tmp_path / "x.ssp", exact_fmus, ssd))
    assert "x.ssp" in str(caught.value)
    assert "\n" not in str(caught.value)
