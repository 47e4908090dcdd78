"""Reconstruction of a system.toml from an SSD: refusals name element and line, all else is preserved.

Truth: the elements inserted here into a composed SSD.
"""

from __future__ import annotations

import re

import pytest

import perilune
from perilune.analysis.cli import main
from tests.support.pages.system_page import SHORT, SSD, write_system

pytestmark = pytest.mark.usefixtures("fmus")
NAME = "holding"
CONNECTION = re.compile(r'(<ssd:Connection [^>]*"star_count")/>')
INSIDE = '<ssd:System name="inner"/>\n    </ssd:Elements>'
BEYOND = {
    "a transformation": (
        CONNECTION,
        r'\1><ssc:IntegerMappingTransformation><ssc:MapEntry source="1" target="2"/>'
        r"</ssc:IntegerMappingTransformation></ssd:Connection>",
        r"Connection \(line \d+\): cannot be expressed",
    ),
    "units that are not converted": (CONNECTION, r'\1 suppressUnitConversion="true"/>', r"Connection \(line \d+\)"),
    "a description": ('name="star" type', 'name="star" description="of stars" type', r"Component star \(line \d+\)"),
    "a system inside": ("</ssd:Elements>", INSIDE, r"inner \(line \d+\): is not a component"),
    "a prefix": ("<ssd:ParameterBinding t", '<ssd:ParameterBinding prefix="x." t', "a prefix or a mapping"),
}


@pytest.fixture
def ssd(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_system(tmp_path)
    perilune.compose(SHORT)
    return tmp_path / NAME / SSD


@pytest.mark.parametrize("case", BEYOND)
def test_beyond_a_system_toml(ssd, capsys, case):
    before, after, line = BEYOND[case]
    text = ssd.read_text(encoding="utf-8")
    changed = text.replace(before, after) if isinstance(before, str) else before.sub(after, text)
    assert changed != text
    ssd.write_text(changed, encoding="utf-8")
    assert main(["compose", NAME, "--output", "back.toml"]) == 2
    error = capsys.readouterr().err
    assert re.search(line, error), error
    assert error.endswith("keep the SSD, which can be simulated as it is\n")
    assert not ssd.parents[1].joinpath("back.toml").exists()


def test_elements_components_and_files(ssd):
    """Steps and sets of components, elements of vectors, and files come with a system.toml to another folder."""
    toml = ssd.with_name("system.toml")
    text = toml.read_text(encoding="utf-8")
    whole = '"satellite.wheel_momentum -> control.wheel_momentum"'
    crossed = ", ".join(f'"satellite.wheel_momentum[{4 - k}] -> control.wheel_momentum[{k}]"' for k in (1, 2, 3))
    text = text.replace(whole, crossed).replace(
        'star = "star_inertial"', 'star = { fmu = "resources/stars.fmu", parameters = ["star.ssv"], step = 0.25 }'
    )
    toml.write_text(text, encoding="utf-8")
    (ssd.parent / "resources").mkdir()
    native = perilune.analysis.runtime.ssp.archive.find_fmu("star_inertial")
    (ssd.parent / "resources/stars.fmu").write_bytes(native.read_bytes())
    (ssd.parent / "star.ssv").write_bytes(
        b'<ssv:ParameterSet version="1.0" name="star" xmlns:ssv="http://ssp-standard.org/SSP1/'
        b'SystemStructureParameterValues"><ssv:Parameters><ssv:Parameter name="sample_period"><ssv:Real value="0.25"/>'
        b"</ssv:Parameter></ssv:Parameters></ssv:ParameterSet>"
    )
    perilune.compose(toml)
    back = perilune.compose(NAME, output="other/system.toml")
    assert [path.name for path in back.paths] == ["system.toml", "stars.fmu", "star.ssv"]
    star = back.source.components["star"]
    assert (star.fmu, star.parameters, star.step) == ("stars", ("star.ssv",), 0.25)
    assert all(each in back.toml for each in crossed.split(", "))
    perilune.compose("other/system.toml")
    assert perilune.compose("other").toml == back.toml


def test_validate_compares_both(ssd, capsys, refusal):
    toml = ssd.with_name("system.toml")
    assert main(["validate", SHORT]) == 0
    assert capsys.readouterr().out == f"{SHORT}: OK\n"
    toml.write_text(toml.read_text(encoding="utf-8").replace("stop_time = 200", "stop_time = 100"), encoding="utf-8")
    assert main(["validate", SHORT]) == 0
    assert f"does not match {SHORT}:" in " ".join(capsys.readouterr().out.split())
    assert "perilune compose holding/system.toml writes its SSD" in refusal(["run", SHORT])
