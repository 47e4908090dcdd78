"""Validation by the schema of a document's version: SSP 2.0 with its additions, SSP 1.0 without; mixed versions.

Truth: the same system as SSP 1.0, sample by sample; the rules and the schemas of SSP 2.0.
"""

import numpy as np
import pytest

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.arrays.documents import in_version_2
from tests.support.builders import (
    component,
    connection,
    document,
    external,
    fly,
    inline,
    pack,
    parameter_set,
    system,
)

RAMP = component("ramp", "ramp", "output y Real m", inline("start=Real:4 m"))
GAIN = component("gain", "gain", "input u Real m; output y Real m")
TEXT = document(system(RAMP, GAIN, connections=connection("ramp.y", "gain.u")))
SIGNATURE = (
    '<ssc:Signature role="authenticity" type="application/octet-stream"><ssc:Content>x</ssc:Content></ssc:Signature>'
)
META = f'<ssc:MetaData kind="quality" type="text/xml"><ssc:Content><a/></ssc:Content>{SIGNATURE}</ssc:MetaData>'


@pytest.mark.parametrize("name", ["Real", "Float64"])
def test_a_system_flies_like_the_same_one_of_version_1(tiny, tmp_path, name):
    text = in_version_2(TEXT).replace(":Real", f":{name}")
    assert text.count('version="2.0"') == 2
    one, two = (fly(pack(tmp_path / f"{n}.ssp", tiny, each)) for n, each in enumerate((TEXT, text)))
    assert one["gain.y"][0] == 12.0
    np.testing.assert_array_equal(one["gain.y"], two["gain.y"])


@pytest.mark.parametrize("versions", [("1.0", "2.0"), ("2.0", "1.0")])
def test_each_document_has_a_version_for_itself(tiny, tmp_path, versions):
    description, values = versions
    ramp = component("ramp", "ramp", "output y Real m", external("resources/set.ssv"))
    text = document(system(ramp)).replace('version="1.0"', f'version="{description}"')
    settings = parameter_set("start=Real:4 m").replace('version="1.0"', f'version="{values}"')
    assert fly(pack(tmp_path / "s.ssp", tiny, text, resources___set__ssv=settings))["ramp.y"][0] == 4.0


def test_metadata_has_no_effect_and_signatures_are_noted(tiny, tmp_path):
    ramp = component("ramp", "ramp", "output y Real m", external("resources/set.ssv"))
    settings = in_version_2(parameter_set("start=Real:4 m")).replace(
        "</ssv:ParameterSet>", f"{META}</ssv:ParameterSet>"
    )
    text = in_version_2(document(system(ramp)))
    text = text.replace("</ssd:SystemStructureDescription>", f"{META}{SIGNATURE}</ssd:SystemStructureDescription>")
    path = pack(tmp_path / "s.ssp", tiny, text, resources___set__ssv=settings)
    notes = prepare_system(path, SystemOptions()).network.notes
    unverified = [note for note in notes if note.endswith("authenticity, application/octet-stream: not verified")]
    assert ["set.ssv" in note for note in unverified].count(True) == 1
    assert ["SystemStructure.ssd" in note for note in unverified].count(True) == 2
    assert fly(path)["ramp.y"][0] == 4.0


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('<ssc:Real unit="m"/>', "<ssc:Clock/>", r"y \(line \d+\): clocks are not supported"),
        ('<ssc:Real unit="m"/>', '<ssc:Real/><ssd:Clock name="c"/>', r"y \(line \d+\): clocks are not supported"),
        ('<ssc:Real unit="m"/>', "<ssc:Binary/>", r"ramp\.y \(line \d+\): is Real in .*, Binary here"),
        ('<ssc:Real unit="m"/>', "<ssc:Float32/>", r"ramp\.y \(line \d+\): is Float64 in .*, Float32 here"),
        ('kind="output"', 'kind="unspecified"', r'y \(line \d+\): kind="unspecified" does not state'),
        ('kind="output"', 'kind="local"', r"ramp\.y \(line \d+\): is output in .*, but local here"),
        ('kind="output"', 'kind="constant"', r"ramp\.y \(line \d+\): is output in .*, but constant here"),
        (
            "<ssd:Component ",
            '<ssd:Component implementation="ScheduledExecution" ',
            r"ramp .*: implementation=.* is not",
        ),
        ('source="resources/ramp.fmu"', "", r"ramp \(line \d+\): no source"),
        ("<ssv:Real", "<ssv:Int8", r"line \d+: not valid SSP 2\.0: .*unit"),
        ('<ssv:Real value="4" unit="m"/>', '<ssv:Int8 value="300"/>', r"line \d+: not valid SSP 2\.0: .*300"),
        ("<ssd:Component ", '<ssd:Component taste="1" ', r"line \d+: not valid SSP 2\.0: .*'taste' is not allowed"),
        (
            'version="2.0" name="test"',
            'version="2.1" name="test"',
            r"version \(line \d+\): SSP version 2\.1 is not supported",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(tiny, tmp_path, old, new, words):
    text = in_version_2(TEXT).replace(old, new, 1)
    assert text.count(new) >= 1
    with pytest.raises(InputError, match=words) as refusal:
        fly(pack(tmp_path / "s.ssp", tiny, text))
    assert "\n" not in refusal.value.text


@pytest.mark.parametrize("new", ["<ssc:Float64/>", '<ssc:Real unit="m"/><ssc:Dimension size="3"/>'])
def test_version_1_has_nothing_of_version_2(tiny, tmp_path, new):
    with pytest.raises(InputError, match=r"line \d+: not valid SSP 1\.0: "):
        fly(pack(tmp_path / "s.ssp", tiny, TEXT.replace('<ssc:Real unit="m"/>', new, 1)))
