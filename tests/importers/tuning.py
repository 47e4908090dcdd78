"""A tunable parameter changed in flight by importers: after half of the steps, by each tool's own means.

`python -m tests.importers.tuning MASTER FMU PARAMETER NUMBER STEP STEPS OUTPUT` prints the outputs at the end.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import fmpy
import numpy as np

from tests.support.foreign.osp import HEAD, simulator

from .masters import Values
from .worker import MARK

Tuner = Callable[[Path, str, float, float, int, Sequence[str], Path], Values]


def tune_fmpy(
    fmu: Path, parameter: str, number: float, step: float, steps: int, outputs: Sequence[str], folder: Path
) -> Values:
    """Change it by a column of the input table."""
    description = fmpy.read_model_description(str(fmu), validate=False)
    start = next(float(each.start) for each in description.modelVariables if each.name == parameter)
    half, end = step * (steps // 2), step * steps
    table = np.array(
        [(0.0, start), (half, start), (half, number), (end, number)], dtype=[("time", float), (parameter, float)]
    )
    flown = fmpy.simulate_fmu(
        str(fmu), False, stop_time=end, step_size=step, output_interval=step, output=list(outputs), input=table
    )
    return {name: float(flown[name][-1]) for name in outputs}


def tune_libcosim(
    fmu: Path, parameter: str, number: float, step: float, steps: int, outputs: Sequence[str], folder: Path
) -> Values:
    """Change it by a manipulator."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimManipulator import CosimManipulator
    from libcosimpy.CosimObserver import CosimObserver

    (folder / "block.fmu").write_bytes(fmu.read_bytes())
    (folder / "OspSystemStructure.xml").write_text(
        f"{HEAD}\n<BaseStepSize>{step}</BaseStepSize>\n<Algorithm>fixedStep</Algorithm>\n"
        f"<Simulators>{simulator('block', 'block')}</Simulators>\n</OspSystemStructure>\n"
    )
    execution = CosimExecution.from_osp_config_file(str(folder / "OspSystemStructure.xml"))
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    assert execution.add_observer(observer)
    assert execution.add_manipulator(manipulator)
    index = execution.slave_index_from_instance_name("block")
    references = {each.name.decode(): each.reference for each in execution.slave_variables(index)}
    assert execution.step(steps // 2)
    assert manipulator.slave_real_values(index, [references[parameter]], [number])
    assert execution.step(steps - steps // 2)
    numbers = observer.last_real_values(index, [references[name] for name in outputs])
    return dict(zip(outputs, map(float, numbers), strict=True))


def tune_ecos(
    fmu: Path, parameter: str, number: float, step: float, steps: int, outputs: Sequence[str], folder: Path
) -> Values:
    """Change it by its setter."""
    from ecospy.EcosSimulation import EcosSimulation
    from ecospy.EcosSimulationStructure import EcosSimulationStructure

    structure = EcosSimulationStructure()
    structure.add_model("block", str(fmu))
    simulation = EcosSimulation(structure=structure, step_size=step)
    simulation.init()
    simulation.step(steps // 2)
    simulation.set_real(f"block::{parameter}", number)
    simulation.step(steps - steps // 2)
    return {name: float(simulation.get_real(f"block::{name}")) for name in outputs}


TUNERS: dict[str, Tuner] = {"FMPy": tune_fmpy, "libcosim": tune_libcosim, "Ecos": tune_ecos}


def main() -> None:
    master, fmu, parameter, number, step, steps, *outputs = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        values = TUNERS[master](Path(fmu), parameter, float(number), float(step), int(steps), outputs, Path(folder))
    print(MARK + json.dumps({key: each.hex() for key, each in values.items()}), flush=True)
    os._exit(0)  # as in `worker`


if __name__ == "__main__":
    main()
