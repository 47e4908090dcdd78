"""Single FMU as a prepared system: its name, its default experiment, refusals.

Truth: the modelDescription.xml written for each case; FMI 2.0.
"""

from __future__ import annotations

import re

import pytest
from fmpy.util import auto_interval

import perilune
from perilune.analysis.cli import main
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.builders import component, document, pack, retouched, system
from tests.support.foreign.odd_fmu import odd_fmu


@pytest.mark.parametrize(
    ("model", "name"),
    [("gain", "gain"), ("Modelica.Blocks.Gain", "gain"), ("a gain", "gain"), ("Verstärker", "Verstärker")],
)
def test_the_component_has_the_models_name(tiny_folder, tmp_path, model, name):
    path = tmp_path / "x.fmu"
    retouched(
        tiny_folder / "native" / "gain.fmu",
        path,
        lambda text: re.sub(r'modelName="[^"]*"', f'modelName="{model}"', text),
    )
    prepared = prepare_system(path)
    assert list(prepared.network.fmus) == [name]
    assert prepared.archive.name == "x"
    assert prepared.network.file == str(path)
    flight = perilune.simulate(path, set={f"{name}.u": 2.0})
    assert set(flight[f"{name}.y"]) == {6.0}


def test_connectors_are_inputs_outputs_and_parameters(tiny):
    kinds = {node.variable: node.kind for node in prepare_system(tiny / "gain.fmu").network.nodes.values()}
    assert kinds == {"factor": "parameter", "u": "input", "y": "output"}
    strings = prepare_system(tiny / "stranger.fmu")
    assert {node.variable for node in strings.network.nodes.values()} == {"u", "y", "word", "length"}
    assert perilune.simulate(tiny / "stranger.fmu", set={"Stranger.word": "four"}).final()["Stranger.length"] == 4.0


def test_an_empty_guid_is_one(tmp_path):
    path = odd_fmu(tmp_path)
    retouched(path, path, lambda text: text.replace('guid="by hand"', 'guid=""'))
    assert perilune.simulate(path, stop_time=0.5).status == "stop_time"
    retouched(path, path, lambda text: text.replace('guid=""', ""))
    with pytest.raises(InputError, match=r"fmiModelDescription \(line 2\): no attribute guid; fix"):
        prepare_system(path)


STEP_SIZE = re.compile(r'stepSize="[^"]*"')


def with_step(folder, step):
    path = odd_fmu(folder)
    return retouched(path, path, lambda text: STEP_SIZE.sub(f'stepSize="{step}"', text))


def test_a_step_size_of_zero_is_none(tmp_path):
    """FMPy's interval for 1 s is 2 ms, as for an FMU that says nothing; in a system, too, the others' step counts."""
    path = with_step(tmp_path, "0.0")
    prepared = prepare_system(path)
    assert prepared.step == auto_interval(1.0)
    said = f"{path}: modelDescription.xml: DefaultExperiment, stepSize: 0.0 is not a step size, and is ignored"
    assert said in prepared.network.notes
    root = system(component("zero", "odd"), component("other", "another"))
    odd_fmu(tmp_path, name="another")
    path = pack(tmp_path / "s.ssp", tmp_path, document(root, step=None))
    prepared = prepare_system(path, SystemOptions(open_inputs="start"))
    assert prepared.step == 0.25
    assert [note for note in prepared.network.notes if "s.ssp!resources/odd.fmu: model" in note and "0.0" in note]


@pytest.mark.parametrize("step", ["-0.1", "nan", "INF"])
def test_a_step_size_that_is_no_step_is_the_fmus(tmp_path, step):
    path = with_step(tmp_path, step)
    words = f"modelDescription.xml: DefaultExperiment, stepSize: {step} is not a positive number of seconds; fix"
    with pytest.raises(InputError, match=words):
        prepare_system(path)
    assert perilune.simulate(path, step=0.125, stop_time=0.5).time[1] == 0.125
    assert perilune.validate(path, step=0.125)[0].problems == ()


def test_open_inputs_of_an_fmu_alone_are_refused_by_choice(tmp_path, capsys):
    path = str(odd_fmu(tmp_path))
    assert perilune.simulate(path, stop_time=0.5).status == "stop_time"
    assert main(["run", path, "--stop-time", "0.5", "--open-inputs", "start"]) == 0
    capsys.readouterr()
    for verb in ("run", "validate"):
        assert main([verb, path, "--open-inputs", "refuse"]) == 2
    lines = capsys.readouterr().err.splitlines()
    remedy = "drive the input by --input, give a value: --set odd.u=VALUE, or --open-inputs start"
    assert lines[0] == f"perilune: {path}: odd.u: input is neither connected nor given a value; {remedy}"
    assert lines[1].startswith(f"perilune: {path}: odd.u: input is neither connected nor given a value; ")
    assert main(["run", path, "--stop-time", "0.5", "--open-inputs", "refuse", "--set", "odd.u=1"]) == 0


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (lambda text: text.replace('fmiVersion="2.0"', 'fmiVersion="1.0"'), ": fmiVersion: '1.0' is not supported; "),
        (
            lambda text: re.sub(
                r"<CoSimulation[^>]*modelIdentifier=\"(\w+)\"[^>]*?(/>|>.*?</CoSimulation>)",
                r'<ModelExchange modelIdentifier="\1"/>',
                text,
                flags=re.DOTALL,
            ),
            ": CoSimulation: not a co-simulation FMU; ",
        ),
    ],
)
def test_what_does_not_fly(tiny_folder, tmp_path, change, expected):
    path = retouched(tiny_folder / "native" / "gain.fmu", tmp_path / "x.fmu", change)
    with pytest.raises(InputError) as error:
        perilune.simulate(path)
    assert str(error.value).startswith(f"{path}{expected}")
    assert perilune.validate(path)[0].problems == (str(error.value),)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"variant": "other"}, "variant: an FMU alone has no variants; leave out variant"),
        ({"set": {"gain.facto": 1}}, "use one of gain.factor, gain.u"),
        ({"set": {"factor": 1}}, "use one of gain.factor, gain.u"),
        ({"parameters": ("x.ssv",)}, "neither the system nor the working folder has a file x.ssv"),
        ({"stop_time": 0.05}, "stop_time: 0.05: 0.05 s from the start are not a whole number of steps of 0.1 s"),
    ],
)
def test_options_that_do_not_fit(tiny_folder, options, expected):
    with pytest.raises(InputError, match=re.escape(expected)):
        prepare_system(tiny_folder / "native" / "gain.fmu", SystemOptions(**options))


def test_a_file_that_is_not_there_and_one_that_is_none(tmp_path):
    with pytest.raises(InputError, match=r"none\.fmu: file: not found"):
        perilune.simulate(tmp_path / "none.fmu")
    (tmp_path / "x.fmu").write_text("no zip")
    with pytest.raises(InputError, match=r"x\.fmu: archive: not a readable zip"):
        perilune.simulate(tmp_path / "x.fmu")
    with pytest.raises(InputError, match="an FMU alone has no SSD; give a system"):
        perilune.stability(tmp_path / "x.fmu")


def test_others_take_its_place(tiny):
    flight = perilune.simulate(tiny / "gain.fmu", use={"gain": tiny / "kilometre_gain.fmu"}, set={"gain.u": 2.0})
    assert set(flight["gain.y"]) == {6.0}


@pytest.mark.parametrize("step", [0.0, -1.0])
def test_a_step_that_is_not_positive_is_refused(tiny_folder, step):
    with pytest.raises(InputError, match=rf"^step: {step}: not a positive number of seconds; give a positive step"):
        perilune.simulate(tiny_folder / "native" / "ramp.fmu", step=step)
