"""Semantics of SSP 1.0 documents, with tiny FMUs whose results are computed by hand.

Truth: the SSP 1.0 standard: unit conversion precedes a LinearTransformation, a prefix is added to names before mapping,
the bindings of an outer system override bindings inside it, and later bindings override earlier ones; numbers by hand.
"""

import math

import pytest

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.builders import (
    MODES,
    NAMESPACES,
    UNITS,
    component,
    connection,
    connectors,
    document,
    external,
    fly,
    inline,
    inline_mapping,
    mapping,
    pack,
    parameter_set,
    system,
)

RAMP = component("ramp", "ramp", "output y Real m; output count Integer; output flag Boolean")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
GAIN_UNTYPED = component("gain", "gain", "input u -; output y -")
LINEAR = '<ssc:LinearTransformation factor="{}" offset="{}"/>'


def boolean_map(*entries):
    inner = "".join(f'<ssc:MapEntry source="{source}" target="{target}"/>' for source, target in entries)
    return f"<ssc:BooleanMappingTransformation>{inner}</ssc:BooleanMappingTransformation>"


def integer_map(*entries):
    return boolean_map(*entries).replace("BooleanMapping", "IntegerMapping")


def enumeration_map(*entries):
    return boolean_map(*entries).replace("BooleanMapping", "EnumerationMapping")


def ramp(start=1.0, rise=0.5):
    return [start + n * rise for n in range(5)]


@pytest.fixture
def flown(tiny, tmp_path):
    """Return a function that runs a root system, packed with further files; options as in SystemOptions."""

    def run(root, more="", files=None, **options):
        path = pack(tmp_path / "system.ssp", tiny, document(root, more=more), **(files or {}))
        return fly(path, **options)

    return run


def test_untyped_connectors_take_the_type_of_the_fmu(flown):
    result = flown(system(RAMP, GAIN_UNTYPED, connections=connection("ramp.y", "gain.u")))
    assert result["gain.y"].tolist() == [3 * y for y in ramp()]
    assert result.units["gain.u"] == "m"


def test_unit_conversion_of_an_angle_through_a_system_connector(flown):
    angle = component("angle", "degree_angle", "output y Real deg")
    result = flown(
        system(angle, declared="output bearing Real rad", connections=connection("angle.y", "bearing")),
        set={"angle.start": 90.0},
    )
    assert result["angle.y"].tolist() == [90.0] * 5
    assert result["bearing"].tolist() == pytest.approx([math.pi / 2] * 5, rel=1e-15)
    assert result.units["bearing"] == "rad"


def test_integer_to_real(flown):
    result = flown(system(RAMP, GAIN_UNTYPED, connections=connection("ramp.count", "gain.u", LINEAR.format(10, 1))))
    assert result["gain.u"].tolist() == [1, 11, 21, 31, 41]
    assert result.types["gain.u"] == "Real"
    assert result.types["ramp.count"] == "Integer"


WHOLE = component("whole", "whole", "input n Integer; input b Boolean; output m Integer; output c Boolean")


def test_boolean_and_integer_mappings(flown):
    wires = connection("ramp.flag", "whole.b", boolean_map(("true", "0"), ("0", "true")))
    wires += connection("ramp.count", "whole.n", integer_map((0, 100), (1, -5), (2, 0), (3, 7), (4, 100)))
    result = flown(system(RAMP, WHOLE, connections=wires), set={"ramp.flag_at": 2})
    assert result["whole.c"].tolist() == [1, 1, 0, 0, 0]
    assert result["whole.m"].tolist() == [100, -5, 0, 7, 100]


def test_a_value_without_an_entry_ends_the_run(flown):
    wires = connection("ramp.count", "whole.n", integer_map((0, 5), (1, 6)))
    result = flown(system(RAMP, WHOLE, connections=wires), set={"whole.b": False})
    assert result.status == "failed"
    assert result.time.tolist() == [0.0, 0.25]
    assert "no entry for 2" in result.message
    assert "ramp.count" in result.message


ENUMERATIONS = (
    '<ssd:Enumerations><ssc:Enumeration name="Phase"><ssc:Item name="low" value="2"/><ssc:Item name="high" value="7"/>'
    "</ssc:Enumeration></ssd:Enumerations>"
)
SOURCE = component("source", "mode_ramp", "output count Enumeration Mode; output y Real m")
MODE = component("mode", "mode", "input n Enumeration Mode; output m Enumeration Mode; input b Boolean")


def test_enumerations_are_values_and_are_mapped_by_item(flown):
    wires = connection(
        "source.count", "mode.n", enumeration_map(("brake", "hover"), ("idle", "idle"), ("hover", "brake"))
    )
    root = system(SOURCE, MODE, connections=wires)
    more = ENUMERATIONS.replace("Phase", "Mode")
    start = {"source.first_count": "brake", "mode.b": False}
    result = flown(root, more, set=start, stop_time=0.0)
    assert result["source.count"].tolist() == [MODES["brake"]]
    assert result["mode.m"].tolist() == [MODES["hover"]]
    assert result.types["mode.m"] == "Enumeration"
    plain = system(SOURCE, MODE, connections=connection("source.count", "mode.n"))
    assert flown(plain, more, set=start, stop_time=0.0)["mode.m"].tolist() == [MODES["brake"]]


def test_enumeration_of_a_system_connector(flown):
    root = system(
        MODE,
        declared="input phase Enumeration Phase",
        connections=connection("phase", "mode.n", enumeration_map(("low", "idle"), ("high", "hover"))),
    )
    options = {"more": ENUMERATIONS, "stop_time": 0.0}
    assert flown(root, **options, set={"phase": "high", "mode.b": True})["mode.m"].tolist() == [MODES["hover"]]
    assert flown(root, **options, set={"phase": "low", "mode.b": True})["mode.m"].tolist() == [MODES["idle"]]


def test_nested_systems_with_names_by_path(flown):
    leaf = system(
        component("gain", "gain", "input u Real m; output y Real m"),
        declared="input in Real m; output out Real m",
        connections=connection("in", "gain.u") + connection("gain.y", "out"),
        name="leaf",
    )
    middle = system(
        leaf,
        component("gain", "gain", "input u Real m; output y Real m"),
        declared="input in Real m; output out Real m",
        connections=connection("in", "leaf.in") + connection("leaf.out", "gain.u") + connection("gain.y", "out"),
        name="middle",
    )
    wires = connection("ramp.y", "middle.in", LINEAR.format(1, 1)) + connection("middle.out", "result")
    root = system(RAMP, middle, declared="output result Real m", connections=wires)
    result = flown(root, set={"middle.gain.factor": 5.0, "middle.leaf.gain.factor": 2.0})
    assert result["middle.leaf.gain.u"].tolist() == [y + 1 for y in ramp()]
    assert result["middle.leaf.in"].tolist() == [y + 1 for y in ramp()]
    assert result["middle.gain.u"].tolist() == [2 * (y + 1) for y in ramp()]
    assert result["result"].tolist() == [10 * (y + 1) for y in ramp()]


def test_an_input_passed_straight_through_a_system(flown):
    inner = system(declared="input a Real m; output b Real m", connections=connection("a", "b"), name="inner")
    wires = connection("ramp.y", "inner.a") + connection("inner.b", "gain.u")
    result = flown(system(inner, GAIN, RAMP, connections=wires))
    assert result["gain.y"].tolist() == [3 * y for y in ramp()]


def test_root_inputs_take_values_in_their_unit(flown):
    root = system(
        GAIN,
        WHOLE,
        declared="input in Real km; input n Integer; input b Boolean",
        connections=connection("in", "gain.u") + connection("n", "whole.n") + connection("b", "whole.b"),
        bindings=inline("in=Real:2000 m; n=Integer:4"),
    )
    result = flown(root, set={"b": True})
    assert result["in"].tolist() == [2.0] * 5
    assert result["gain.u"].tolist() == [2000.0] * 5
    assert (result["whole.m"].tolist(), result["whole.c"].tolist()) == ([4] * 5, [1] * 5)


def test_unconnected_inputs_take_values_and_undeclared_ones_keep_their_start(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(GAIN, component("delay", "delay", "output y Real m"))))
    assert fly(path, set={"gain.u": 4.0})["gain.y"].tolist() == [12.0] * 5
    assert fly(path, set={"gain.u": 4.0})["delay.y"].tolist() == [5.0, 7.0, 7.0, 7.0, 7.0]
    prepared = prepare_system(path, SystemOptions(set={"gain.u": 4.0}))
    assert prepared.network.notes == ["delay.u: input not declared in the description, keeps 7.0"]


def test_an_output_without_source_is_noted_and_not_recorded(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, declared="output finished Boolean; output x Real m")))
    result = fly(path)
    assert result.status == "stop_time"
    assert not {"x", "finished"} & result.signals.keys()
    assert [note.partition(":")[0] for note in prepare_system(path).network.notes] == ["finished", "x"]


def test_parameter_sets_inline_and_external_in_any_unit(flown):
    root = system(
        component("ramp", "ramp", "output y Real m", inline("start=Real:0.002 km")),
        component("gain", "gain", "input u Real m", external("resources/values.ssv")),
        connections=connection("ramp.y", "gain.u"),
    )
    files = {"resources___values__ssv": parameter_set("factor=Integer:4")}  # Integer to Real
    result = flown(root, files=files)
    assert result["gain.u"].tolist() == ramp(2.0)
    assert result["gain.y"].tolist() == [4 * y for y in ramp(2.0)]


def entry(source, target, inner="", attributes=""):
    return f'<ssm:MappingEntry source="{source}" target="{target}" {attributes}>{inner}</ssm:MappingEntry>'


@pytest.mark.parametrize("is_inline", [True, False])
def test_prefix_then_mapping_then_transformation(flown, is_inline):
    entries = (
        entry("pre.a", "ramp.start", LINEAR.format(10, 1))
        + entry("pre.b", "gain.factor", attributes='suppressUnitConversion="true"')
        + entry("pre.a", "ramp.slope", attributes='suppressUnitConversion="true"')
        + entry("pre.flag", "ramp.inverted", boolean_map(("1", "false"), ("false", "true")))
        + entry("pre.when", "ramp.flag_at", integer_map((1, 2), (2, 3)))
    )
    values = "a=Real:0.5 m; b=Real:7 km; flag=Boolean:false; when=Integer:1; unused=Real:1"
    if is_inline:
        binding = inline(values, "pre.", inline_mapping(entries))
    else:
        binding = external("resources/v.ssv", "pre.", '<ssd:ParameterMapping source="resources/m.ssm"/>')
    root = system(RAMP, GAIN, connections=connection("ramp.y", "gain.u"), bindings=binding)
    files = {"resources___v__ssv": parameter_set(values), "resources___m__ssm": mapping(entries)}
    result = flown(root, files=files)
    assert result["ramp.y"].tolist() == [6.0 + 0.5 * 0.25 * n for n in range(5)]
    assert result["gain.y"].tolist() == [7 * y for y in result["ramp.y"]]
    assert result["ramp.flag"].tolist() == [1, 1, 0, 0, 0]


def test_enumeration_parameters(flown):
    root = system(
        SOURCE,
        bindings=inline("which=String:hover", mapping=inline_mapping(entry("which", "source.first_count"))),
    )
    assert flown(root, stop_time=0.0)["source.count"].tolist() == [7]
    root = system(
        SOURCE,
        bindings=inline(
            "which=Enumeration:a",
            mapping=inline_mapping(
                entry("which", "source.first_count", enumeration_map(("a", "brake"), ("b", "idle")))
            ),
        ),
    )
    assert flown(root, stop_time=0.0)["source.count"].tolist() == [2]


def test_precedence(flown):
    """Component's own, its system's, the root's, --parameters in turn, --set: each wins over those before it."""
    names = ("component", "later", "inner", "root", "file", "second", "set")
    number = {name: float(index + 1) for index, name in enumerate(names)}

    def start(upto):
        used = {name: number[name] if name in names[: names.index(upto) + 1] else None for name in names}

        def binding(name, path):
            return inline(f"{path}=Real:{used[name]}") if used[name] is not None else ""

        inner = system(
            component("ramp", "ramp", "output y Real m", binding("component", "start") + binding("later", "start")),
            bindings=binding("inner", "ramp.start"),
            name="inner",
        )
        root = system(inner, bindings=binding("root", "inner.ramp.start"))
        files = {
            f"resources___{name}__ssv": parameter_set(f"inner.ramp.start=Real:{number[name]}")
            for name in ("file", "second")
        }
        options = {"parameters": tuple(f"{name}.ssv" for name in ("file", "second") if used[name] is not None)}
        if used["set"] is not None:
            options["set"] = {"inner.ramp.start": number["set"]}
        return flown(root, files=files, **options)["inner.ramp.y"][0]

    assert [start(name) for name in names] == list(number.values())


def test_later_bindings_and_files_win(flown):
    root = system(RAMP, bindings=inline("ramp.start=Real:1") + inline("ramp.start=Real:2"))
    assert flown(root)["ramp.y"][0] == 2.0
    files = {f"resources___{n}__ssv": parameter_set(f"ramp.start=Real:{n}") for n in (8, 9)}
    assert flown(root, files=files, parameters=("8.ssv", "9.ssv"))["ramp.y"][0] == 9.0
    assert flown(root, files=files, parameters=("9.ssv", "8"))["ramp.y"][0] == 8.0


def test_system_parameter_connectors_reach_components(flown):
    inner = system(
        component(
            "ramp", "ramp", "output y Real m; output flag Boolean; parameter start Real m; parameter inverted Boolean"
        ),
        declared="parameter p Real km; parameter up Boolean",
        connections=connection("p", "ramp.start", LINEAR.format(1, 5))
        + connection("up", "ramp.inverted", boolean_map(("true", "false"), ("false", "true"))),
        name="inner",
    )
    root = system(
        inner,
        declared="parameter q Real m; parameter up Boolean",
        connections=connection("q", "inner.p") + connection("up", "inner.up"),
    )
    result = flown(root, set={"q": 3000.0, "up": False})
    assert result["inner.ramp.y"][0] == 3005.0
    assert result["inner.ramp.flag"].tolist() == [1] * 5
    assert flown(root, set={"q": 3000.0, "up": True})["inner.ramp.flag"].tolist() == [0] * 5
    assert flown(root)["inner.ramp.y"][0] == 1.0  # no value: the FMU keeps its own
    assert flown(root, set={"inner.p": 4.0})["inner.ramp.y"][0] == 4005.0


DICTIONARY = (
    f'<ssb:SignalDictionary version="1.0" {NAMESPACES}><ssb:DictionaryEntry name="height"><ssc:Real unit="km"/>'
    f"</ssb:DictionaryEntry>{UNITS.replace('ssd:Units', 'ssb:Units')}</ssb:SignalDictionary>"
)


@pytest.mark.parametrize("is_inline", [True, False])
def test_signal_dictionaries(flown, is_inline):
    """A bus: the ramp writes it at the root, in m; a system inside reads it, kept in km meanwhile."""
    declared = connectors("inout height Real km")
    reference = '<ssd:SignalDictionaryReference name="{}" dictionary="bus">{}</ssd:SignalDictionaryReference>'
    declared = declared.replace('kind="inout"', 'kind="{}"')
    inner = system(
        component("gain", "gain", "input u Real m; output y Real m"),
        reference.format("here", declared.format("output")),
        connections=connection("here.height", "gain.u"),
        name="inner",
    )
    if is_inline:
        dictionary = f'<ssd:SignalDictionary name="bus">{DICTIONARY}</ssd:SignalDictionary>'
    else:
        dictionary = '<ssd:SignalDictionary name="bus" source="resources/bus.ssb"/>'
    root = system(
        RAMP,
        inner,
        reference.format("there", declared.format("input")),
        connections=connection("ramp.y", "there.height"),
        extra=f"<ssd:SignalDictionaries>{dictionary}</ssd:SignalDictionaries>",
    )
    result = flown(root, files={"resources___bus__ssb": DICTIONARY})
    assert result["bus.height"].tolist() == pytest.approx([y / 1000 for y in ramp()], rel=1e-15)
    assert result["inner.gain.u"].tolist() == pytest.approx(ramp(), rel=1e-15)


def test_variants_of_one_archive(tiny, tmp_path):
    other = document(system(RAMP, bindings=inline("ramp.start=Real:50")), stop=0.5)
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP)), high__ssd=other)
    assert fly(path)["ramp.y"].tolist() == ramp()
    assert fly(path, variant="high")["ramp.y"].tolist() == [50.0, 50.5, 51.0]
    assert fly(path, variant="high.ssd")["ramp.y"][0] == 50.0
    assert fly(path, variant="SystemStructure")["ramp.y"][0] == 1.0


def test_an_archive_and_its_folder_fly_alike(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP)))
    folder = tmp_path / "s"
    (folder / "resources").mkdir(parents=True)
    (folder / "SystemStructure.ssd").write_text(document(system(RAMP)))
    (folder / "resources" / "ramp.fmu").write_bytes((tiny / "ramp.fmu").read_bytes())
    assert fly(folder)["ramp.y"].tolist() == fly(path)["ramp.y"].tolist() == ramp()
