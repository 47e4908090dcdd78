"""Blocks with state outside their FMI variables: a simulation in a library, created again for each run.

Truth: the closed form of an oscillator; the process that simulates; a count of existing simulations.
"""

import os
import subprocess
import sys
import zipfile
from contextlib import closing

import fmpy.validation
import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.runtime.process.opening import open_simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.fmus_src.catalogue import blocks_in_file
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.runtime import BlockInstance, StateError

LIBRARY = '''"""A simulator that keeps its state to itself."""
import cmath

LIVING = 0


class Oscillator:
    def __init__(self, amplitude, frequency):
        global LIVING
        LIVING += 1
        self.phasor, self.frequency, self.burnt = amplitude + 0j, frequency, False

    def __del__(self):
        global LIVING
        LIVING -= 1

    def advance(self, h):
        if self.burnt:
            raise RuntimeError("a simulation of the flight before")
        self.phasor *= cmath.exp(1j * self.frequency * h)
        return self.phasor.real
'''
BLOCK = '''"""An oscillator in a library."""
import os

import library
from perilune import Block, ExternalState, Input, Output, Parameter


class MyOscillator(Block):
    """x = amplitude cos(frequency t), whose phase the library alone knows."""

    python_only = True
    amplitude = Parameter(1.0, unit="m", description="of x")
    frequency = Parameter(2.0, unit="rad/s", description="of x")
    fails_at = Parameter(1e9, unit="s", description="when the library fails")
    force = Input(0.0, unit="m", description="added to x")
    x = Output(1.0, unit="m", description="deflection")
    process = Output(0, description="that simulates")
    living = Output(0, description="simulations in it")
    simulation = ExternalState("the oscillator")

    def initialize(self) -> None:
        self.simulation = library.Oscillator(self.amplitude, self.frequency)
        self.x, self.process, self.living = self.amplitude, os.getpid(), library.LIVING

    def step(self, t: float, h: float) -> None:
        if t + h > self.fails_at:
            raise RuntimeError("the library fails")
        self.x = self.simulation.advance(h) + self.force
        self.living = library.LIVING
'''
CAMPAIGN = """
system = "my_oscillator"
trials = 40
seed = 5

[draw."my_oscillator.amplitude"]
distribution = "uniform"
low = 0.5
high = 2.0

[metric.last]
expression = "my_oscillator.x / my_oscillator.amplitude"
reduction = "final"

[metric.living]
expression = "my_oscillator.living"
reduction = "max"

[success]
expression = "last > -2"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("external")
    (folder / "library.py").write_text(LIBRARY)
    (folder / "my_oscillator.py").write_text(BLOCK)
    (folder / "c.toml").write_text(CAMPAIGN)
    build_python_fmu(block_in(folder / "my_oscillator.py"), folder / "my_oscillator.fmu")
    return folder


def block_in(path):
    (block,) = blocks_in_file(path)
    return block


def fly(folder, **options):
    return perilune.simulate(folder / "my_oscillator.fmu", step=0.1, stop_time=2.0, **options)


def test_a_flight_is_that_of_the_library(folder):
    flight = fly(folder, set={"my_oscillator.amplitude": 3.0})
    np.testing.assert_allclose(flight["my_oscillator.x"], 3.0 * np.cos(2.0 * flight.time), atol=1e-13)


def test_it_flies_in_another_process_unless_in_process_is_requested(folder):
    assert set(fly(folder)["my_oscillator.process"]) & {os.getpid()} == set()
    assert set(fly(folder, in_process=True)["my_oscillator.process"]) == {os.getpid()}


def test_trials_do_not_depend_on_workers_or_order(folder, tmp_path):
    tables = []
    for workers in (1, 2):
        output = tmp_path / str(workers)
        flown = perilune.batch(
            folder / "my_oscillator.fmu", folder / "c.toml", step=0.1, stop_time=2.0, workers=workers, output=output
        )
        tables.append((output / "trials" / "000000.parquet").read_bytes())
        rows = flown.table()
        np.testing.assert_allclose(rows["metric.last"].to_numpy(), np.cos(4.0), atol=1e-13)
        assert set(rows["metric.living"].to_pylist()) == {1}, "one simulation at a time"
    assert tables[0] == tables[1]
    for trial in (7, 3):
        replayed = perilune.replay(output, trial)
        assert (replayed.stored, replayed.differences) == (True, ())


def test_a_failing_library_fails_the_flight(folder, capsys):
    options = ["--set", "my_oscillator.fails_at=1", "--step", "0.1", "--stop-time", "2"]
    assert main(["run", str(folder / "my_oscillator.fmu"), *options]) == 1
    printed = capsys.readouterr()
    assert "RuntimeError: the library fails" in printed.err + printed.out
    assert "my_oscillator.py" in printed.err + printed.out


@pytest.mark.parametrize("here", [False, True])
def test_what_needs_its_state_refuses_it_by_name(folder, here):
    prepared = prepare_system(folder / "my_oscillator.fmu", SystemOptions(in_process=here))
    problem = (
        "my_oscillator: simulation depends on state outside of the FMU, which cannot be saved or perturbed; measure"
    )
    with closing(open_simulation(prepared)) as simulation, pytest.raises(InputError, match=problem):
        simulation.memory()


def test_a_component_makes_it_anew_and_does_not_save_it(folder):
    component = BlockInstance(block_in(folder / "my_oscillator.py"))
    assert component.block.simulation is None
    component.start()
    first = component.block.simulation
    component.do_step(0.0, 0.1)
    with pytest.raises(StateError, match="simulation of my_oscillator is external state, which cannot be saved"):
        component.get_state()
    component.settle()
    assert component.block.simulation is not first
    assert component.block.simulation.phasor == 1.0


def test_the_model_description_says_so(folder):
    assert not fmpy.validation.validate_fmu(folder / "my_oscillator.fmu")
    simulation = fmpy.read_model_description(folder / "my_oscillator.fmu").coSimulation
    assert (simulation.canGetAndSetFMUstate, simulation.canSerializeFMUstate) == (False, False)
    with zipfile.ZipFile(folder / "my_oscillator.fmu") as archive:
        assert b'<ExternalState names="simulation"/>' in archive.read("modelDescription.xml")


def test_fmpy_flies_it(folder):
    """In another process, as its library is in the FMU."""
    code = f"""
import fmpy, math
rows = fmpy.simulate_fmu({str(folder / "my_oscillator.fmu")!r}, stop_time=2.0, step_size=0.1, output=["x"])
print(max(abs(x - math.cos(2.0 * t)) for t, x in rows) < 1e-13)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=100)
    assert done.stdout.strip() == "True", done.stderr


def test_a_native_block_cannot_have_one(folder, tmp_path, capsys):
    (tmp_path / "library.py").write_text(LIBRARY)
    (tmp_path / "mine.py").write_text(BLOCK.replace("    python_only = True\n", ""))
    assert main(["export", str(tmp_path / "mine.py")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "MyOscillator.simulation: an ExternalState, which a native FMU cannot have; add python_only = True" in line


def test_one_name_for_two_is_refused(folder):
    base = block_in(folder / "my_oscillator.py")
    with pytest.raises(perilune.DeclarationError, match="simulation: both an ExternalState and a variable"):
        type("Other", (base,), {"__doc__": "Other.", "simulation": perilune.State(0.0, description="a number")})


def test_an_undeclared_object_is_refused_with_the_remedy(folder, tmp_path, capsys):
    (tmp_path / "library.py").write_text(LIBRARY)
    (tmp_path / "mine.py").write_text(BLOCK.replace('    simulation = ExternalState("the oscillator")\n', ""))
    assert main(["export", str(tmp_path / "mine.py")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "self.simulation is not declared in MyOscillator" in line
    assert "or ExternalState(...) for an object of a library" in line
