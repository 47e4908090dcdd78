"""Importers that know nothing of Perilune, each flying one FMU with its own start values and no inputs."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import fmpy
import numpy as np

from tests.support.foreign.osp import HEAD, simulator


@dataclass(frozen=True)
class Flight:
    """A flight of ``steps`` steps (s) whose scalar Real ``outputs`` are read at the end.

    ``change`` names a tunable parameter and the number that it has from the middle on.
    """

    step: float
    steps: int
    outputs: tuple[str, ...]
    change: tuple[str, float] | None = None

    @property
    def half(self) -> int:
        """Number of steps before the change."""
        return self.steps // 2


Values = dict[str, float]
Master = Callable[[Path, Flight, Path], Values]  # FMU, flight, an empty folder


def fly_fmpy(fmu: Path, flight: Flight, folder: Path) -> Values:
    """Fly it with FMPy, which changes a parameter by a column of its input table."""
    end, table = flight.step * flight.steps, None
    if flight.change is not None:
        parameter, number = flight.change
        variables = fmpy.read_model_description(str(fmu), validate=False).modelVariables
        start, middle = (
            float(next(each.start for each in variables if each.name == parameter)),
            flight.step * flight.half,
        )
        rows = [(0.0, start), (middle, start), (middle, number), (end, number)]
        table = np.array(rows, dtype=[("time", float), (parameter, float)])
    flown = fmpy.simulate_fmu(
        str(fmu), False, stop_time=end, step_size=flight.step, output_interval=flight.step,
        output=list(flight.outputs), input=table,
    )  # fmt: skip
    return {name: float(flown[name][-1]) for name in flight.outputs}


def fly_libcosim(fmu: Path, flight: Flight, folder: Path) -> Values:
    """Fly it with libcosim, which changes a parameter by a manipulator."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver

    shutil.copy(fmu, folder / "block.fmu")
    (folder / "OspSystemStructure.xml").write_text(
        f"{HEAD}\n<BaseStepSize>{flight.step}</BaseStepSize>\n<Algorithm>fixedStep</Algorithm>\n"
        f"<Simulators>{simulator('block', 'block')}</Simulators>\n</OspSystemStructure>\n"
    )
    execution = CosimExecution.from_osp_config_file(str(folder / "OspSystemStructure.xml"))
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    assert execution.add_observer(observer)
    assert execution.add_manipulator(manipulator)
    index = execution.slave_index_from_instance_name("block")
    references = {each.name.decode(): each.reference for each in execution.slave_variables(index)}
    assert execution.step(flight.half)
    if flight.change is not None:
        parameter, number = flight.change
        assert manipulator.slave_real_values(index, [references[parameter]], [number])
    assert execution.step(flight.steps - flight.half)
    numbers = observer.last_real_values(index, [references[name] for name in flight.outputs])
    return dict(zip(flight.outputs, map(float, numbers), strict=True))


def fly_ecos(fmu: Path, flight: Flight, folder: Path) -> Values:
    """Fly it with Ecos, which changes a parameter by its setter."""
    from ecospy.EcosSimulation import EcosSimulation
    from ecospy.EcosSimulationStructure import EcosSimulationStructure

    structure = EcosSimulationStructure()
    structure.add_model("block", str(fmu))
    simulation = EcosSimulation(structure=structure, step_size=flight.step)
    simulation.init()
    simulation.step(flight.half)
    if flight.change is not None:
        parameter, number = flight.change
        simulation.set_real(f"block::{parameter}", number)
    simulation.step(flight.steps - flight.half)
    return {name: float(simulation.get_real(f"block::{name}")) for name in flight.outputs}


def fly_container(fmu: Path, flight: Flight, folder: Path) -> Values:
    """Fly it inside a container FMU of the FMU Manipulation Toolbox, with FMPy; no parameter is changed there."""
    assert flight.change is None
    shutil.copy(fmu, folder / "block.fmu")
    rows = "".join(f"OUTPUT;block.fmu;{name};;{name}\n" for name in flight.outputs)
    (folder / "box.csv").write_text(f"rule;from_fmu;from_port;to_fmu;to_port\nFMU;block.fmu;;;\n{rows}")
    tool = Path(sys.executable).with_name("fmucontainer")
    version = ["-fmi", "3"] if fmpy.read_model_description(str(fmu), validate=False).fmiVersion == "3.0" else []
    command = [str(tool), *version, "-container", f"box.csv:{flight.step}", "-fmu-directory", "."]
    completed = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if completed.returncode or not (folder / "box.fmu").exists():
        raise RuntimeError((completed.stderr or completed.stdout).strip().splitlines()[-1])
    return fly_fmpy(folder / "box.fmu", flight, folder)


MASTERS: dict[str, Master] = {
    "FMPy": fly_fmpy,
    "libcosim": fly_libcosim,
    "Ecos": fly_ecos,
    "fmucontainer": fly_container,
}
