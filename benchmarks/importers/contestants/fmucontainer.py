"""fmucontainer of the FMU Manipulation Toolbox: one FMU that contains the system's FMUs and steps them in C."""

from __future__ import annotations

import logging
import shutil
import tempfile
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from ..contestant import ExchangeSystem, Fly, Unavailable, Values


def prepare(course: ExchangeSystem, sequential: bool = False) -> Fly:
    """Prepare a container FMU of the .ssp, simulated by FMPy with one doStep per communication point.

    By default it steps all FMUs and then exchanges values (Jacobi); ``sequential`` exchanges after each FMU, in the
    order of the SSD. FMUs are initialised in the order of their connections.
    """
    description, folder = _build(course, sequential)
    references = {
        variable.name: variable.valueReference
        for variable in description.modelVariables
        if variable.causality in ("local", "output")
    }
    # the container calls the FMUs by the names of their files
    files = {component: fmu.name for component, fmu in course.prepared.network.fmus.items()}
    requested: dict[str, int] = {}
    for name in course.names:
        component = next(component for component in files if name.startswith(f"{component}."))
        requested[name] = references[f"{files[component]}.{name.removeprefix(f'{component}.')}"]
    start, step = course.prepared.start, course.prepared.step

    def fly(steps: int) -> Values:
        slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="container",
        )
        slave.instantiate()
        slave.setupExperiment(startTime=start, stopTime=start + steps * step)
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        for n in range(steps):
            slave.doStep(start + n * step, step)
        values = slave.getReal(list(requested.values()))
        slave.terminate()
        slave.freeInstance()
        return dict(zip(requested, values, strict=True))

    return fly


def _build(course: ExchangeSystem, sequential: bool):  # type: ignore[no-untyped-def]
    """Build the container; return its description and the unpacked folder.

    Start values are passed explicitly, since the toolbox does not read parameter bindings.
    """
    try:
        from fmu_manipulation_toolbox.assembly import Assembly
    except ImportError as error:
        problem = f"fmu-manipulation-toolbox cannot be imported: {error}"
        raise Unavailable(f"{problem}; pip install fmu-manipulation-toolbox") from error
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.ERROR)
    folder = Path(tempfile.mkdtemp(prefix="perilune_container_"))
    shutil.copy(course.ssp, folder / "container.ssp")
    assembly = Assembly("container.ssp", fmu_directory=folder, default_step_size=course.prepared.step)
    assembly.root.sequential = sequential
    fmus = course.prepared.network.fmus
    if len({fmu.name for fmu in fmus.values()}) < len(fmus):
        raise Unavailable("the toolbox names FMUs by their files, and two components share one")
    for (component, variable), value in course.settings().items():
        text = str(value).lower() if isinstance(value, bool) else str(value)
        assembly.root.add_start_value(f"container.dir/{fmus[component].name}.fmu", variable, text)
    assembly.make_fmu()
    container = str(folder / "container.fmu")
    return read_model_description(container), str(extract(container))
