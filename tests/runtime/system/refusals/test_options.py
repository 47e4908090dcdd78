"""Options that do not fit the system are refused, and a missing time or step is requested.

Truth: the table of refusals in docs/command_line.md and the FMI 2.0 and SSP 1.0 standards, each violated in one place
by a file here. They are read through the command line's `main` in this process.
"""

import re

import pytest

from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import (
    component,
    connection,
    document,
    fly,
    inline,
    inline_mapping,
    parameter_set,
    retouched,
    system,
)
from tests.support.refused import PLAIN, RAMP, ssp


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--set", "gain.factor=101"], ["--set: gain.factor", "maximum"]),
        (["--set", "gain.factor=x"], ["--set: gain.factor", "'x' is not of type Real"]),
        (["--set", "gain.factor=nan"], ["--set: gain.factor", "not finite"]),
        (["--set", "ramp.flag_at=1.5"], ["--set: ramp.flag_at", "not of type Integer"]),
        (["--set", "ramp.first_count=3000000000"], ["--set: ramp.first_count", "32 bits"]),
        (["--set", "ramp.inverted=yes"], ["--set: ramp.inverted", "write true or false"]),
        (["--set", "ramp.stort=1"], ["--set: ramp.stort", "matches no parameter", "ramp.start"]),
        (["--set", "ramp.start"], ["--set: ramp.start", "not of the form"]),
        (["--set", "=1"], ["--set: =1", "not of the form"]),
        (["--use", "gain"], ["--use: gain", "not of the form SLOT=FMU"]),
        (["--use", "gian=gain"], ["--use: gian", "no such component", "gain, ramp"]),
        (["--use", "gain=nothing_of_this_name"], ["--use: gain=nothing_of_this_name", "no such FMU is built"]),
        (["--use", "gain=nowhere/x.fmu"], ["--use: nowhere/x.fmu", "no such file"]),
        (["--parameters", "nowhere.ssv"], ["--parameters", "has a file nowhere.ssv"]),
        (["--variant", "other"], ["--variant", "no variant other", "SystemStructure"]),
        (["--stop-time", "1.1"], ["--stop-time", "whole number of steps", "for instance --stop-time 1"]),
        (["--stop-time", "-1"], ["--stop-time"]),
        (["--step", "0"], ["--step", "not a positive number"]),
        (["--step", "-0.1"], ["--step", "not a positive number"]),
        (["--step", "0.3"], ["--stop-time", "whole number of steps of 0.3 s"]),
        (["--step", "1e-13"], ["--step", "GB, over 25% of the free memory"]),
        (["--step", "1e-320"], ["--step", "does not advance a time of 1 s"]),
        (["--stop-time", "1e300"], ["--stop-time", "does not advance", "earlier times"]),
        (["--feedthrough", "nobody"], ["--feedthrough: nobody", "use one of gain, ramp"]),
        (
            ["--feedthrough", "gain", "--no-feedthrough", "gain"],
            ["--feedthrough: gain: is also given to --no-feedthrough"],
        ),
        (["--no-feedthrough", "nobody"], ["--no-feedthrough: nobody", "use one of gain, ramp"]),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) and value[0].startswith("--") else "",
)
def test_options(tmp_path, tiny, refused, options, words):
    refused(ssp(tmp_path, tiny), *words, options=options)


def test_allow_unmatched_lets_parameters_pass(tmp_path, tiny, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = ssp(tmp_path, tiny, system(RAMP, bindings=inline("ramp.stort=Real:1; romp.x=Real:1")))
    assert main(["run", str(path), "--allow-unmatched", "--set", "a.b=1"]) == 0


ENTRY = '<ssm:MappingEntry source="{}" target="ramp.start"/>'
FLAWS = {
    "unknown name": (
        inline("ramp.start=Real:4; ramp.stort=Real:1"),
        "ramp.stort (line",
        "matches no parameter: not applied",
    ),
    "unknown unit": (
        inline("ramp.start=Real:4 ell"),
        "ramp.start (line",
        "unit ell is not defined here: the value is used",
    ),
    "twice": (
        inline("ramp.start=Real:3; ramp.start=Real:4"),
        "ramp.start (line",
        "given twice in one parameter set: this",
    ),
    "mapping of nothing": (
        inline("a=Real:4", mapping=inline_mapping(ENTRY.format("a") + ENTRY.format("b"))),
        "b (line",
        "has no such parameter: not applied",
    ),
}


@pytest.mark.parametrize("name", FLAWS)
def test_flaws_of_parameter_sets_are_noted(tmp_path, tiny, capsys, name):
    """The values that are left are those of the set, in the FMU's own unit."""
    bindings, *words = FLAWS[name]
    path = ssp(tmp_path, tiny, system(RAMP, bindings=bindings))
    with pytest.raises(InputError, match="allow_unmatched"):
        fly(path)
    assert fly(path, allow_unmatched=True)["ramp.y"][0] == 4.0
    assert main(["validate", str(path), "--allow-unmatched"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert all(each in said for each in words), said


def test_flaws_of_a_parameter_file_are_noted(tmp_path, tiny):
    file = tmp_path / "a.ssv"
    file.write_text(parameter_set("ramp.start=Real:4 ell"))
    path = ssp(tmp_path, tiny, system(RAMP))
    prepared = prepare_system(path, SystemOptions(parameters=(str(file),), allow_unmatched=True))
    assert any("unit ell is not defined here" in note for note in prepared.network.notes)


def test_stop_time_that_is_missing(tmp_path, tiny, refused):
    refused(ssp(tmp_path, tiny, stop=None), "stopTime", "give --stop-time")


def test_step_that_no_one_proposes(tmp_path, tiny, refused):
    def forget(text):
        return re.sub(r'<DefaultExperiment[^>]*stepSize="[^"]*"[^>]*/>', "", text)

    retouched(tiny / "ramp.fmu", tmp_path / "ramp.fmu", forget)
    fmu = (tmp_path / "ramp.fmu").read_bytes()
    path = ssp(tmp_path, tiny, system(RAMP), step=None, files={"resources___ramp__fmu": fmu})
    refused(path, "step", "neither the SSD nor an FMU", "give --step")


def test_step_annotation_that_is_no_number(tmp_path, tiny, refused):
    text = document(PLAIN).replace('size="0.25"', 'size="often"')
    refused(ssp(tmp_path, tiny, files={"SystemStructure__ssd": text}), "CommunicationStep", "positive number")


def test_a_parameter_that_the_system_shares_cannot_be_set_apart(tmp_path, tiny, refused):
    """The system's value would replace it, so what was asked for would not fly."""
    inside = "input u Real m; output y Real m; parameter factor Real"
    parts = component("gain", "gain", inside), component("second", "gain", inside)
    wires = connection("shared", "gain.factor") + connection("shared", "second.factor")
    root = system(*parts, connections=wires, declared="parameter shared Real", bindings=inline("shared=Real:2"))
    words = ["--set: second.factor", "3.0 differs from 2.0", "gain.factor, second.factor", "set shared instead"]
    refused(ssp(tmp_path, tiny, root), *words, options=["--set", "second.factor=3", "--open-inputs", "start"])
