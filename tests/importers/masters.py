"""Importers that know nothing of Perilune, each flying one FMU with its own start values and no inputs.

A master takes the FMU, the step (s), their number, the names of scalar Real outputs and an empty folder, and returns
the values of these outputs at the end.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import fmpy
import numpy as np

from tests.support.foreign.osp import HEAD, libcosim, simulator

Values = dict[str, float]
Master = Callable[[Path, float, int, Sequence[str], Path], Values]


def fly_fmpy(fmu: Path, step: float, steps: int, outputs: Sequence[str], folder: Path) -> Values:
    flown = fmpy.simulate_fmu(
        str(fmu), False, stop_time=step * steps, step_size=step, output_interval=step, output=list(outputs)
    )
    return {name: float(np.asarray(flown[name])[-1]) for name in outputs}


def fly_libcosim(fmu: Path, step: float, steps: int, outputs: Sequence[str], folder: Path) -> Values:
    shutil.copy(fmu, folder / "block.fmu")
    (folder / "OspSystemStructure.xml").write_text(
        f"{HEAD}\n<BaseStepSize>{step}</BaseStepSize>\n<Algorithm>fixedStep</Algorithm>\n"
        f"<Simulators>{simulator('block', 'block')}</Simulators>\n</OspSystemStructure>\n"
    )
    rows = libcosim(folder, [f"block.{name}" for name in outputs], steps)
    return dict(zip(outputs, map(float, rows[-1]), strict=True))


def fly_ecos(fmu: Path, step: float, steps: int, outputs: Sequence[str], folder: Path) -> Values:
    from ecospy.EcosSimulation import EcosSimulation
    from ecospy.EcosSimulationStructure import EcosSimulationStructure

    structure = EcosSimulationStructure()
    structure.add_model("block", str(fmu))
    simulation = EcosSimulation(structure=structure, step_size=step)
    simulation.init()
    simulation.step(steps)
    return {name: float(simulation.get_real(f"block::{name}")) for name in outputs}


def fly_container(fmu: Path, step: float, steps: int, outputs: Sequence[str], folder: Path) -> Values:
    """The FMU inside a container FMU of the FMU Manipulation Toolbox, flown by FMPy."""
    shutil.copy(fmu, folder / "block.fmu")
    rows = "".join(f"OUTPUT;block.fmu;{name};;{name}\n" for name in outputs)
    (folder / "box.csv").write_text(f"rule;from_fmu;from_port;to_fmu;to_port\nFMU;block.fmu;;;\n{rows}")
    tool = Path(sys.executable).with_name("fmucontainer")
    version = ["-fmi", "3"] if fmpy.read_model_description(str(fmu), validate=False).fmiVersion == "3.0" else []
    command = [str(tool), *version, "-container", f"box.csv:{step}", "-fmu-directory", "."]
    made = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    if made.returncode or not (folder / "box.fmu").exists():
        raise RuntimeError((made.stderr or made.stdout).strip().splitlines()[-1])
    return fly_fmpy(folder / "box.fmu", step, steps, outputs, folder)


MASTERS: dict[str, Master] = {
    "FMPy": fly_fmpy,
    "libcosim": fly_libcosim,
    "Ecos": fly_ecos,
    "fmucontainer": fly_container,
}
