"""Mappings of SSP 2.0: values without an entry are unchanged; integers may be mapped to numbers of enumerations.

Truth: the rules of SSP 2.0, Transformation Choice. SSP 1.0 does not define values without an entry; these are refused.
"""

import numpy as np
import pytest

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.arrays.documents import in_version_2
from tests.support.builders import MODES, component, connection, document, fly, inline, inline_mapping, pack, system

RAMP = component("ramp", "ramp", "output count Integer")
WHOLE = component("whole", "whole", "input n Integer; output m Integer")
MAPPED = (
    "<ssc:IntegerMappingTransformation>"
    '<ssc:MapEntry source="0" target="10"/><ssc:MapEntry source="2" target="20"/>'
    "</ssc:IntegerMappingTransformation>"
)


def test_a_connection_keeps_what_has_no_entry(tiny, tmp_path):
    text = document(system(RAMP, WHOLE, connections=connection("ramp.count", "whole.n", MAPPED)))
    run = fly(pack(tmp_path / "s.ssp", tiny, in_version_2(text)))
    np.testing.assert_array_equal(run["whole.m"], [10, 1, 20, 3, 4])
    old = fly(pack(tmp_path / "t.ssp", tiny, text))
    assert old.status == "failed"


@pytest.mark.parametrize(("given", "expected"), [(0, 10), (2, 20), (5, 5)])
def test_a_parameter_set_keeps_what_has_no_entry(tiny, tmp_path, given, expected):
    entry = f'<ssm:MappingEntry source="x" target="first_count">{MAPPED}</ssm:MappingEntry>'
    ramp = component("ramp", "ramp", "output count Integer", inline(f"x=Int32:{given}", mapping=inline_mapping(entry)))
    run = fly(pack(tmp_path / "s.ssp", tiny, in_version_2(document(system(ramp)))))
    assert run["ramp.count"][0] == expected


@pytest.mark.parametrize(("given", "expected"), [(0, 10), (3, 3)])
def test_a_connected_parameter_keeps_what_has_no_entry(tiny, tmp_path, given, expected):
    ramp = component("ramp", "ramp", "output count Integer; parameter first_count Integer")
    root = system(
        ramp,
        declared="parameter p Integer",
        bindings=inline(f"p=Int32:{given}"),
        connections=connection("p", "ramp.first_count", MAPPED),
    )
    run = fly(pack(tmp_path / "s.ssp", tiny, in_version_2(document(root))))
    assert run["ramp.count"][0] == expected


def test_numbers_of_an_enumeration_are_mapped(tiny, tmp_path):
    numbers = (
        f'<ssc:IntegerMappingTransformation><ssc:MapEntry source="{MODES["idle"]}" target="{MODES["hover"]}"/>'
        "</ssc:IntegerMappingTransformation>"
    )
    entries = "".join(f'<ssc:Item name="{name}" value="{number}"/>' for name, number in MODES.items())
    more = f'<ssd:Enumerations><ssc:Enumeration name="Mode">{entries}</ssc:Enumeration></ssd:Enumerations>'
    mode = component(
        "mode",
        "mode",
        "input n Enumeration Mode; output m Enumeration Mode",
        inline(
            "x=Enumeration:idle",
            mapping=inline_mapping(f'<ssm:MappingEntry source="x" target="n">{numbers}</ssm:MappingEntry>'),
        ),
    )
    path = pack(tmp_path / "s.ssp", tiny, in_version_2(document(system(mode), more=more)))
    assert prepare_system(path, SystemOptions()).settings.variables["mode", "n"] == MODES["hover"]
