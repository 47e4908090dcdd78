"""Diagrams of nested systems, signal dictionaries, sums, single elements, conversions, and single FMUs.

Truth: the connections in the descriptions written here, and the geometry of the SVG.
"""

from collections import Counter

import pytest

from perilune.analysis.documents.diagram.diagram import make_diagram
from perilune.analysis.documents.of.system import connection_table
from perilune.analysis.options.fault import parse_fault
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.builders import component, connection, connectors, document, pack, system
from tests.support.diagrams.geometry import EXACT, Drawing, assert_readable
from tests.support.foreign.osp import simulator, structure, write_osp
from tests.support.large_systems import build_mixers

pytestmark = pytest.mark.usefixtures("fmus", "layout_bundle")
RAMP = component("ramp", "ramp", "output y Real m; output count Integer; output flag Boolean; parameter start Real m")
GAIN = component("gain", "gain", "input u Real m; output y Real m; parameter factor Real 1")
DELAY = component("delay", "delay", "input u Real m; output y Real m")


@pytest.fixture
def native(tiny_folder):
    """Return the tiny FMUs, which are not loaded here."""
    return tiny_folder / "native"


@pytest.fixture
def figure(native, tmp_path):
    """Return the diagram of a system, packed with further files, and its table of connections."""

    def draw(root, faults=(), files=None, **options):
        path = pack(tmp_path / "system.ssp", native, document(root), **(files or {}))
        diagram = make_diagram(prepare_system(path, SystemOptions(**options)), faults)
        drawing = Drawing(str(diagram.svg))
        assert_readable(drawing)
        return drawing, connection_table(diagram.system).rows

    return draw


def texts(drawing):
    return [text for text, _ in drawing.labels]


def test_a_system_inside_another(figure):
    inner = system(
        GAIN, DELAY, name="inner", declared="input x Real m; output z Real m; parameter k Real 1",
        connections=connection("x", "gain.u") + connection("gain.y", "delay.u") + connection("delay.y", "z")
        + connection("k", "gain.factor"),
    )  # fmt: skip
    root = system(
        RAMP, inner, component("after", "gain", "input u Real m; output y Real m"),
        declared="output result Real m; parameter k Real 1; parameter begin Real m",
        connections=connection("ramp.y", "inner.x") + connection("inner.z", "after.u") + connection("after.y", "result")
        + connection("k", "inner.k") + connection("begin", "ramp.start"),
    )  # fmt: skip
    drawing, _ = figure(root, set={"k": 2.0, "begin": 1.0})
    assert Counter(drawing.connections()) == Counter([
        ("ramp.y", "inner.x"), ("inner.x", "inner.gain.u"), ("inner.gain.y", "inner.delay.u"),
        ("inner.delay.y", "inner.z"), ("inner.z", "after.u"), ("after.y", "result"), ("k", "inner.k"),
        ("inner.k", "inner.gain.factor"), ("begin", "ramp.start"),
    ])  # fmt: skip
    frame = drawing.blocks["inner"]
    assert all(frame.holds(drawing.blocks[f"inner.{name}"]) for name in ("gain", "delay"))
    assert not frame.overlaps(drawing.blocks["ramp"])
    ends = {line.connections[0]: (line.points[0], line.points[-1]) for line in drawing.lines}
    assert ends["ramp.y", "inner.x"][1][0] == pytest.approx(frame.left, abs=EXACT)
    assert ends["inner.z", "after.u"][0][0] == pytest.approx(frame.right, abs=EXACT)
    for first, second in (("ramp.y", "inner.x"), ("inner.x", "inner.gain.u")), (
        ("inner.delay.y", "inner.z"), ("inner.z", "after.u"),
    ):  # fmt: skip
        assert ends[first][1][1] == pytest.approx(ends[second][0][1], abs=EXACT)  # level where they meet at the frame


def test_a_signal_dictionary(figure):
    entry = '<ssb:DictionaryEntry name="length"><ssc:Real unit="m"/></ssb:DictionaryEntry>'
    extra = (
        f'<ssd:SignalDictionaries><ssd:SignalDictionary name="bus"><ssb:SignalDictionary version="1.0">{entry}'
        "</ssb:SignalDictionary></ssd:SignalDictionary></ssd:SignalDictionaries>"
    )
    bus = f'<ssd:SignalDictionaryReference name="signals" dictionary="bus">{connectors("inout length Real m")}'
    root = system(
        RAMP, DELAY, f"{bus}</ssd:SignalDictionaryReference>",
        connections=connection("ramp.y", "signals.length") + connection("signals.length", "delay.u"), extra=extra,
    )  # fmt: skip
    drawing, rows = figure(root)
    assert Counter(drawing.connections()) == Counter([("ramp.y", "bus.length"), ("bus.length", "delay.u")])
    assert [row[:2] for row in rows] == [("ramp.y", "signals.length"), ("signals.length", "delay.u")]


def test_what_happens_on_the_way(figure):
    gain = component("gain", "kilometre_gain", "input u Real km; output y Real km")
    wire = connection("ramp.y", "gain.u", '<ssc:LinearTransformation factor="2" offset="-7"/>')
    drawing, rows = figure(system(RAMP, gain, connections=wire))
    assert rows[0][-1] == "m → km, · 2 \N{MINUS SIGN} 7"
    assert rows[0][-1] in texts(drawing)


def test_elements_of_vectors(native, tmp_path):
    """Two elements of ten, one of another vector, and all in another order."""
    build_mixers(tmp_path)
    whole = "; ".join(f"{kind} {name}[{k}] Real 1" for kind, name in (("input", "u"), ("output", "y")) for k in
                      range(1, 11))  # fmt: skip
    mixers = [component(name, f"mixer{number}", whole) for number, name in enumerate(("a", "b", "c"))]
    wires = [("a.y[3]", "b.u[1]"), ("a.y[4]", "b.u[2]"), ("c.y[10]", "b.u[10]"), ("b.y[1]", "a.u[1]")]
    wires += [(f"b.y[{11 - k}]", f"c.u[{k}]") for k in range(1, 11)]
    root = system(*mixers, connections="".join(connection(*wire) for wire in wires))
    fmus = {f"resources/mixer{k}.fmu": (tmp_path / "native" / f"mixer{k}.fmu").read_bytes() for k in range(3)}
    path = pack(tmp_path / "system.ssp", native, document(root), **fmus)
    diagram = make_diagram(prepare_system(path, SystemOptions(open_inputs="start")))
    drawing = Drawing(str(diagram.svg))
    assert_readable(drawing)
    assert Counter(drawing.connections()) == Counter(wires)
    assert [row[2:] for row in connection_table(diagram.system).rows] == [
        (2, "", "[3..4] → [1..2]"), (1, "", "[10]"), (1, "", "[1]"), (10, "", "[10 elements] → [1..10]"),
    ]  # fmt: skip
    assert {"a [3..4] → [1..2]", "c [10]"} <= set(texts(drawing))


def test_a_sum_of_osp(tiny_folder, tmp_path):
    signals = "".join(
        f'<SignalConnection><Variable simulator="{name}" name="y"/><Signal function="s" name="in[{k}]"/>'
        "</SignalConnection>" for k, name in enumerate(("one", "other"))
    )  # fmt: skip
    text = structure(
        simulator("one", "ramp") + simulator("other", "ramp") + simulator("last", "delay"),
        f'{signals}<SignalConnection><Signal function="s" name="out"/><Variable simulator="last" name="u"/>'
        "</SignalConnection>",
        '<Functions><Sum name="s" inputCount="2"/></Functions>\n',
    )
    diagram = make_diagram(prepare_system(write_osp(tmp_path, tiny_folder, text), SystemOptions(stop_time=1.0)))
    drawing = Drawing(str(diagram.svg))
    assert_readable(drawing)
    assert Counter(drawing.connections()) == Counter([("one.y", "last.u"), ("other.y", "last.u")])
    assert [row[-1] for row in connection_table(diagram.system).rows] == ["added", "added"]


def test_an_fmu_alone_has_its_ports(native):
    drawing = Drawing(str(make_diagram(prepare_system(native / "gain.fmu")).svg))
    assert list(drawing.blocks) == ["gain"]
    assert {"u", "y"} <= {text for text, _ in drawing.labels_of("gain")}


def test_faults_are_in_their_block(figure):
    root = system(RAMP, GAIN, connections=connection("ramp.y", "gain.u"))
    drawing, _ = figure(root, faults=[parse_fault("gain.u=bias:3@0.5..0.75")])
    assert any("u=bias:3@0.5..0.75" in text for text, _ in drawing.labels_of("gain"))
    assert not any("bias" in text for text, _ in drawing.labels_of("ramp"))


def test_what_is_in_a_slot(figure, native):
    slot = component("gain", "gain", "input u Real m; output y Real m")
    root = system(RAMP, slot, connections=connection("ramp.y", "gain.u"))
    drawing, _ = figure(root, use={"gain": str(native / "delay.fmu")})
    assert "delay, replaces gain" in [text for text, _ in drawing.labels_of("gain")]
