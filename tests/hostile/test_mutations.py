"""Systems, parameter sets and campaigns with something changed: accepted, or refused with an `InputError` in one line.

Truth: good documents; the reader raises nothing else, whatever is moved, removed, replaced or flipped in them.
"""

from __future__ import annotations

import copy
import warnings
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from perilune.analysis.campaigns.spec.checks import check_plan
from perilune.analysis.campaigns.spec.plan import read_plan
from perilune.analysis.common.errors import InputError
from perilune.analysis.reports.figures.reading import read_figures
from perilune.analysis.runtime.ssp.archive import SystemArchive, open_system
from perilune.analysis.runtime.ssp.parameter_sets import read_parameter_file
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.analysis.stability.request.reading import read_declaration
from tests.hostile.campaigns import GOOD
from tests.support.builders import (
    component,
    connection,
    document,
    external,
    inline,
    inline_mapping,
    pack,
    parameter_set,
    system,
)
from tests.support.lengths import either
from tests.support.refused import GAIN, RAMP, WIRED

pytestmark = pytest.mark.flies
MAPPED = inline_mapping(
    '<ssm:MappingEntry source="a" target="ramp.slope">'
    '<ssc:LinearTransformation factor="2" offset="1"/></ssm:MappingEntry>'
)
INNER = system(
    component("gain", "gain", "input u Real m; output y Real m"),
    declared="input in Real km; output out Real m",
    connections=connection("in", "gain.u") + connection("gain.y", "out", "<ssc:LinearTransformation factor='2'/>"),
    name="inner",
)
SSD = document(
    system(
        RAMP,
        GAIN,
        component("whole", "whole", "input n Integer; input b Boolean; output m Integer"),
        INNER,
        connections=WIRED
        + connection("ramp.count", "whole.n")
        + connection("ramp.flag", "whole.b")
        + connection("gain.y", "inner.in"),
        bindings=inline("ramp.start=Real:2 km; ramp.flag_at=Integer:3; ramp.inverted=Boolean:true")
        + inline("a=Real:1", mapping=MAPPED)
        + external("resources/a.ssv"),
    )
)
SOURCE = parameter_set("ramp.first_count=Integer:3")
SSV = parameter_set("ramp.start=Real:2 m; ramp.flag_at=Integer:3; a=Boolean:true; b=String:x; c=Enumeration:y")
CAMPAIGN = (
    GOOD
    + """
[derive]
twice = "2 * ramp.slope"
[set]
"ramp.start" = 2.0
[draw."ramp.flag_at"]
distribution = "choice"
values = [1, 2, 3]
weights = [1, 2, 1]
[draw.pair]
distribution = "correlated_normal"
names = ["one", "two"]
mean = [0, 1]
covariance = [[1, 0.5], [0.5, 1]]
[metric.least]
expression = "min(ramp.y, abs(ramp.y) ** 2)"
reduction = "min"
window = [0, 1]
[group]
by = "ramp.flag_at"
[fault.stuck]
connector = "ramp.y"
kind = "bias"
value = "twice"
start = 0.5
[record]
final = ["ramp.y"]
every = 2
signals = ["ramp.y"]
[requirement.high]
expression = "end > 0"
share = 0.5
confidence = 0.9
[scatter.s]
x = "end"
y = "least"
[configuration.a]
use = {}
"""
)
JUNK = st.sampled_from(
    [
        *("", " ", "0", "-1", "1e400", "-1.7e308", "nan", "NaN", "inf", "INF", "true", "x", "ramp", "ramp.y", "a.b[1]"),
        *("9" * 40, "9" * 5000, "2147483648", "0x1", "1_0", "\u202e", "é", "%00", "..", "/etc/passwd"),
        *("[]", "[1, 2]", "{}", "{a = 1}", '""', '"x"', '"1/0"', '"9**9**9"', "[[1]]", "[nan]", "1979-05-27"),
    ]
)


@st.composite
def changed_xml(draw, text):
    """A document with one to three changes to its elements, or to its characters."""
    root = etree.fromstring(text.encode())
    for _ in range(draw(st.integers(1, 3))):
        elements = list(root.iter(etree.Element))
        element = draw(st.sampled_from(elements))
        other = draw(st.sampled_from(elements))
        change = draw(st.sampled_from(["value", "remove", "name", "delete", "twice", "move", "tag", "text"]))
        names = sorted(element.attrib)
        if change in ("value", "remove", "name") and names:
            name = draw(st.sampled_from(names))
            value = element.attrib.pop(name)
            if change == "value":
                element.set(name, draw(st.one_of(JUNK, st.sampled_from(sorted(root.xpath("//@*"))))))
            if change == "name":
                element.set(draw(st.sampled_from(["name", "value", "kind", "source", "unit", "x"])), value)
        elif change == "text":
            element.text = draw(JUNK)
        elif change == "tag":
            element.tag = other.tag
        elif element is not root and other not in list(element.iter()):
            if change == "delete":
                element.getparent().remove(element)
            elif change == "move":
                other.append(element)
            else:
                other.append(copy.deepcopy(element))
    return etree.tostring(root)


@st.composite
def changed_text(draw, text):
    """A document of lines with one to three changes to these, or to its bytes."""
    lines = text.splitlines()
    for _ in range(draw(st.integers(1, 3))):
        index = draw(st.integers(0, len(lines) - 1))
        change = draw(st.sampled_from(["value", "value", "delete", "twice", "swap", "key"]))
        key, equals, _ = lines[index].partition(" = ")
        if change == "value" and equals:
            lines[index] = f"{key} = {draw(JUNK)}"
        elif change == "key":
            lines[index] = lines[index].replace(key, draw(JUNK), 1)
        elif change == "delete":
            lines[index] = ""
        else:
            other = draw(st.integers(0, len(lines) - 1))
            if change == "swap":
                lines[index], lines[other] = lines[other], lines[index]
            else:
                lines.insert(other, lines[index])
    return "\n".join(lines).encode()


@st.composite
def flipped(draw, text):
    """A document with a few bits changed."""
    changed = bytearray(text.encode())
    for position in draw(st.lists(st.integers(0, 8 * len(changed) - 1), min_size=1, max_size=3)):
        changed[position // 8] ^= 1 << position % 8
    return bytes(changed)


def check(read):
    """Let a reader accept, or refuse in one line; it warns of nothing."""
    refusal = None
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        try:
            read()
        except InputError as error:
            refusal = error
    assert refusal is None or ("\n" not in str(refusal) and refusal.problem)


@pytest.fixture(scope="module")
def good(tiny_folder, tmp_path_factory):
    """The good system, its FMUs read once."""
    path = pack(tmp_path_factory.mktemp("good") / "good.ssp", tiny_folder / "native", SSD, resources___a__ssv=SOURCE)
    archive = open_system(path)
    return archive, {}


def read_system(good, content):
    archive, loaded = good
    files = {**{name: archive.files[name] for name in archive.files}, "SystemStructure.ssd": content}
    changed = SystemArchive("good", "good.ssp", archive.path, files)
    prepared = prepare_system(changed, SystemOptions(allow_unmatched=True, open_inputs="start"), loaded)
    read_declaration(prepared.network.description)
    read_figures(prepared)


def test_the_originals_are_good(good, tmp_path):
    read_system(good, SSD.encode())
    assert read_parameter_file(SSV.encode(), "a.ssv")
    read_campaign(good, CAMPAIGN.encode(), tmp_path)


def read_campaign(good, content, folder):
    path = Path(folder) / "hostile.toml"
    path.write_bytes(content)
    check_plan(read_plan(good[0].path, str(path), SystemOptions()))


@settings(max_examples=either(4000, 350))
@given(content=changed_xml(SSD) | flipped(SSD))
def test_any_system(good, content):
    check(lambda: read_system(good, content))


@settings(max_examples=either(4000, 350))
@given(content=changed_xml(SSV) | flipped(SSV))
def test_any_parameter_set(content):
    check(lambda: read_parameter_file(content, "a.ssv"))


@settings(max_examples=either(4000, 350))
@given(content=changed_text(CAMPAIGN) | flipped(CAMPAIGN))
def test_any_campaign(good, content, tmp_path_factory):
    check(lambda: read_campaign(good, content, tmp_path_factory.getbasetemp()))
