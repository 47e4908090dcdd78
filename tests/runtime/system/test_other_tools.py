"""Files of other tools within the standard: simulated like files written by Perilune.

Truth: the same system as written by Perilune, sample by sample; results by hand for the tiny FMUs.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.builders import (
    MODES,
    component,
    connection,
    connectors,
    document,
    fly,
    inline,
    inline_mapping,
    pack,
    parameter_set,
    retouched,
    system,
)
from tests.support.foreign.plain_system import GAIN, RAMP, ROOT, WIRED, same


def test_connections_have_no_direction(tiny, tmp_path, plain):
    backwards = connection("gain.u", "ramp.y") + connection("out", "gain.y")
    root = system(RAMP, GAIN, connections=backwards, declared=ROOT)
    same(fly(pack(tmp_path / "s.ssp", tiny, document(root))), plain)


def test_a_backward_connection_transforms_what_flows(tiny, tmp_path):
    inner = '<ssc:LinearTransformation factor="2" offset="1"/>'
    actual = [
        fly(
            pack(
                tmp_path / f"{start}.ssp", tiny, document(system(RAMP, GAIN, connections=connection(start, end, inner)))
            )
        )
        for start, end in (("ramp.y", "gain.u"), ("gain.u", "ramp.y"))
    ]
    np.testing.assert_array_equal(actual[0]["gain.u"], actual[1]["gain.u"])
    assert actual[1]["gain.u"][0] == 2.0 * 1.0 + 1.0


def test_two_of_a_kind_are_refused_either_way(tiny, tmp_path):
    for start, end in (("ramp.y", "gain.y"), ("gain.y", "ramp.y")):
        path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=connection(start, end))))
        with pytest.raises(InputError, match=r"which cannot be connected; connect an output with an input"):
            fly(path)


def test_an_empty_element_is_the_system_itself(tiny, tmp_path, plain):
    wires = WIRED + connection("gain.y", "out").replace('endConnector="out"', 'endElement="" endConnector="out"')
    assert 'endElement=""' in wires
    same(fly(pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=wires, declared=ROOT)))), plain)


def test_a_signal_dictionary_with_inout(tiny, tmp_path, plain):
    entry = '<ssb:DictionaryEntry name="length"><ssc:Real unit="m"/></ssb:DictionaryEntry>'
    dictionary = f'<ssb:SignalDictionary version="1.0">{entry}</ssb:SignalDictionary>'
    signals = (
        f'<ssd:SignalDictionaries><ssd:SignalDictionary name="bus">{dictionary}</ssd:SignalDictionary>'
        "</ssd:SignalDictionaries>"
    )
    reference = (
        f'<ssd:SignalDictionaryReference name="signals" dictionary="bus">{connectors("inout length Real m")}'
        "</ssd:SignalDictionaryReference>"
    )
    wires = (
        connection("ramp.y", "signals.length") + connection("signals.length", "gain.u") + connection("gain.y", "out")
    )
    root = system(RAMP, GAIN, reference, connections=wires, declared=ROOT, extra=signals)
    same(fly(pack(tmp_path / "s.ssp", tiny, document(root))), plain)


def test_an_integer_is_an_enumeration_s_value(tiny, tmp_path):
    enumeration = "".join(f'<ssc:Item name="{name}" value="{value}"/>' for name, value in MODES.items())
    more = f'<ssd:Enumerations><ssc:Enumeration name="Mode">{enumeration}</ssc:Enumeration></ssd:Enumerations>'
    mode = component("mode", "mode", "input n Enumeration Mode; output m Enumeration Mode")
    root = system(RAMP, mode, connections=connection("ramp.count", "mode.n"))
    result = fly(pack(tmp_path / "s.ssp", tiny, document(root, more=more)))
    assert result["mode.m"].tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]


def test_an_enumeration_is_set_by_name_or_value(tiny, tmp_path):
    """OMSimulator sets items by their values, and writes them so."""
    declared = "input n Enumeration Mode; output m Enumeration Mode"
    enumeration = "".join(f'<ssc:Item name="{name}" value="{value}"/>' for name, value in MODES.items())
    more = f'<ssd:Enumerations><ssc:Enumeration name="Mode">{enumeration}</ssc:Enumeration></ssd:Enumerations>'
    for index, settings in enumerate(("n=Enumeration:hover", "n=Enumeration:7", "n=Integer:7", "n=String:hover")):
        mode = component("mode", "mode", declared, inline(settings))
        path = pack(tmp_path / f"{index}.ssp", tiny, document(system(mode), more=more))
        assert set(fly(path)["mode.m"]) == {7.0}
        assert [set(fly(path, set={"mode.n": item})["mode.m"]) for item in ("brake", "2", 2)] == [{2.0}] * 3
        with pytest.raises(InputError, match=r"mode\.n: the enumeration has no item 3; use one of brake, hover, idle"):
            fly(path, set={"mode.n": 3})
    mode = component("mode", "mode", declared, inline("n=Real:7"))
    with pytest.raises(
        InputError, match="the value is of type Real, but the variable is of type Enumeration; give an Enumeration"
    ):
        fly(pack(tmp_path / "s.ssp", tiny, document(system(mode), more=more)))


def test_an_empty_unit_is_none(tiny, tmp_path, plain):
    """OMSimulator's Parker demonstrator declares unit=""."""
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    text = document(root).replace('kind="input"><ssc:Real unit="m"', 'kind="input"><ssc:Real unit=""')
    values = inline("factor=Real:3 1").replace('unit="1"', 'unit=""')
    assert 'unit=""' in text
    same(fly(pack(tmp_path / "s.ssp", tiny, text)), plain)
    bound = component("gain", "gain", "input u Real m; output y Real m", values)
    assert 'unit=""' in bound
    root = system(RAMP, bound, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    same(fly(pack(tmp_path / "s.ssp", tiny, document(root))), plain)


def test_open_inputs_keep_their_starts_when_asked(tiny, tmp_path, capsys, refusal):
    cross = component("cross", "cross", "input a Real m; input b Real m; output ya Real m; output yb Real m")
    path = pack(
        tmp_path / "s.ssp",
        tiny,
        document(system(cross, declared="input in Real m", connections=connection("in", "cross.b"))),
    )
    with pytest.raises(InputError, match=r"in \(line \d+\), cross\.a \(line \d+\): 2 inputs are neither connected nor"):
        fly(path)
    result = fly(path, open_inputs="start")
    assert set(result["cross.ya"]) == {2.0 * 0.25}
    assert set(result["cross.yb"]) == {0.5 + 1.0}
    assert "--open-inputs start" in refusal(["validate", str(path)])
    assert main(["validate", str(path), "--open-inputs", "start"]) == 0
    assert "cross.b: open input, keeps 0.5" in " ".join(capsys.readouterr().out.split())
    assert perilune.validate(path, open_inputs="start")[0].problems == ()


def test_system_options_are_for_systems_and_fmus_alone(tiny, tmp_path, refusal):
    (tmp_path / "set.ssv").write_text(parameter_set("ramp.start=Real:2"))
    assert "apply only to systems" in refusal(["validate", str(tmp_path / "set.ssv"), "--step", "1"])
    assert main(["validate", str(tiny / "ramp.fmu"), "--step", "1", "--set", "ramp.start=2"]) == 0
    assert "use one of ramp.start, ramp.slope" in refusal(["validate", str(tiny / "ramp.fmu"), "--set", "ramp.star=2"])


def test_a_campaign_may_name_the_file_of_its_system(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=WIRED)))
    campaign = tmp_path / "c.toml"
    campaign.write_text(
        'system = "s.ssp"\ntrials = 2\nseed = 1\n\n[success]\nexpression = "out > 0"\n\n'
        '[metric.out]\nexpression = "gain.y"\nreduction = "final"\n'
    )
    assert perilune.batch(path, campaign, workers=1).summary["default"].success_rate == 1.0


def test_a_step_that_does_not_advance_time(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=WIRED)))
    with pytest.raises(InputError, match=r"a step of 0\.25 s does not advance a time of 1e\+300 s"):
        fly(path, stop_time=1e300)


@pytest.mark.parametrize(
    ("name", "variability"),
    [
        ("flag", ' variability="continuous"'),  # a Boolean output, as stock pythonfmu FMUs of old have it
        ("slope", ""),  # a parameter, continuous by default, which FMI forbids and fmpy does not even read
    ],
)
def test_flaws_are_remarks_unless_strict(tiny, tmp_path, capsys, plain, name, variability):
    """Variabilities that do not fit: FMPy dislikes them, they run."""
    flawed = retouched(
        tiny / "ramp.fmu",
        tmp_path / "ramp.fmu",
        lambda text: re.sub(rf'(name="{name}"[^>]*) variability="\w+"', rf"\1{variability}", text),
    )
    root = system(RAMP, GAIN, connections=WIRED + connection("gain.y", "out"), declared=ROOT)
    path = pack(tmp_path / "s.ssp", tiny, document(root), resources___ramp__fmu=flawed.read_bytes())
    same(fly(path), plain)
    assert fly(path, set={"ramp.slope": 4.0})["ramp.y"].tolist() == [1.0 + 4.0 * 0.25 * n for n in range(5)]
    for target in (path, flawed):
        assert main(["validate", str(target)]) == 0
        assert re.search(rf'[Vv]ariable "{name}" \(line', capsys.readouterr().out)
        assert main(["validate", str(target), "--strict"]) == 2
        assert re.search(rf'ramp\.fmu.*modelDescription\.xml.*[Vv]ariable "{name}".*; fix', capsys.readouterr().err)


def test_what_a_mapping_leaves_out_is_said(tiny, tmp_path, capsys):
    """OMSimulator applies it under its own name; SSP 1.0, ParameterBindings: non-mapped values are not applied."""
    entry = inline_mapping('<ssm:MappingEntry source="a" target="factor"/>')
    binding = inline("a=Real:2; u=Real:5 m", mapping=entry)
    path = pack(tmp_path / "s.ssp", tiny, document(system(component("gain", "gain", "input u Real m", binding))))
    with pytest.raises(
        InputError, match=r"gain\.u .*; add u of SystemStructure\.ssd line \d+ to the mapping, which omits it; or"
    ):
        fly(path)
    assert main(["validate", str(path), "--open-inputs", "start"]) == 0
    said = " ".join(capsys.readouterr().out.split())  # a longer path breaks the line elsewhere
    assert re.search(r"gain\.ParameterBinding \(line \d+\): its mapping has no entry for u: not applied", said)
    settings = fly(
        pack(tmp_path / "s.ssp", tiny, document(system(component("gain", "gain", "output y Real m", binding))))
    )
    assert set(settings["gain.y"]) == {2.0 * 0.0}  # u keeps its start


def test_a_constant_takes_no_value(tiny, tmp_path):
    """SSP 1.0, ParameterBindings: variability other than constant."""
    frozen = retouched(
        tiny / "ramp.fmu",
        tmp_path / "ramp.fmu",
        lambda text: re.sub(
            r'(name="slope"[^>]*) causality="\w+" variability="\w+"', r'\1 variability="constant"', text
        ),
    )
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP)), resources___ramp__fmu=frozen.read_bytes())
    assert fly(path)["ramp.y"][-1] == 1.0 + 2.0
    with pytest.raises(InputError, match=r"set: ramp\.slope: matches no parameter: it is a constant; use one of"):
        fly(path, set={"ramp.slope": 4.0})


def test_messages_speak_of_the_file(tiny, tmp_path):
    root = system(component("ramp", "rump", "output y Real m"))
    folder = tmp_path / "system"
    folder.mkdir()
    (folder / "SystemStructure.ssd").write_text(document(root))
    with pytest.raises(InputError, match=r"no file resources/rump\.fmu in the system") as refusal:
        fly(folder)
    assert "build_fmus" not in str(refusal.value)
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=WIRED), stop=1.1))
    with pytest.raises(InputError, match=r"DefaultExperiment: stopTime 1\.1: 1\.1 s from the start"):
        fly(path)
    with pytest.raises(InputError, match=r"stop_time: 1\.2: 1\.2 s from the start"):
        fly(path, stop_time=1.2)


def test_one_variant_is_validated_or_all(tiny, tmp_path, capsys, refusal):
    good, bad = document(system(RAMP)), document(system(RAMP, bindings=inline("ramp.stort=Real:1")))
    path = str(pack(tmp_path / "s.ssp", tiny, good, other__ssd=bad))
    assert main(["validate", path]) == 0
    assert main(["validate", path, "--variant", "other"]) == 2
    assert main(["validate", path, "--all-variants"]) == 2
    assert "other.ssd: ramp.stort" in " ".join(capsys.readouterr().err.split())
    assert "--all-variants" in refusal(["validate", path, "--all-variants", "--variant", "other"])
