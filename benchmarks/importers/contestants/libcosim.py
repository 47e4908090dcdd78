"""libcosim, the co-simulation library of the Open Simulation Platform, through libcosimpy."""

from __future__ import annotations

import tempfile
import zipfile
from pathlib import Path

from lxml import etree

from perilune.fmus_src.export.ssp_package import DESCRIPTION, SSD_NAMESPACE

from ..contestant import ExchangeSystem, Fly, Unavailable, Values

OSP = "http://opensimulationplatform.com/SSP/OSPAnnotations"
COMMON = "http://ssp-standard.org/SSP1/SystemStructureCommon"
ANNOTATION = """<ssc:Annotation type="com.opensimulationplatform"><osp:Algorithm>\
<osp:FixedStepAlgorithm baseStepSize="{step!r}" numWorkerThreads="{threads}"/></osp:Algorithm></ssc:Annotation>"""


def prepare(course: ExchangeSystem, threads: int = 0) -> Fly:
    """Prepare an execution, which is read from the .ssp for every simulation, with ``threads`` additional threads.

    Its fixed-step algorithm is Jacobi: all FMUs are set from the last exchange, then all step, then all are read. At
    the start values are exchanged as often as there are FMUs, after which they no longer change.
    """
    try:
        from libcosimpy import CosimEnums, CosimExecution, CosimLogging, CosimObserver
    except ImportError as error:
        raise Unavailable(f"libcosimpy cannot be imported: {error}; pip install libcosimpy") from error
    CosimLogging.log_output_level(CosimLogging.CosimLogLevel.ERROR)
    archive = _readable_copy(course, threads)
    fmus = course.prepared.network.fmus
    references: dict[str, dict[str, int]] = {name: {} for name in fmus}
    for name in course.names:
        component = next(component for component in fmus if name.startswith(f"{component}."))
        variable = name.removeprefix(f"{component}.")
        references[component][name] = fmus[component].variables[variable].reference

    def fly(steps: int) -> Values:
        execution = CosimExecution.CosimExecution.from_ssp_file(str(archive))
        setters = {
            "Real": execution.real_initial_value,
            "Integer": execution.integer_initial_value,
            "Boolean": execution.boolean_initial_value,
            "String": execution.string_initial_value,
        }
        index = {component: execution.slave_index_from_instance_name(component) for component in fmus}
        for (component, name), value in course.settings().items():
            variable = fmus[component].variables[name]
            if not setters[variable.type](index[component], variable.reference, value):
                raise RuntimeError(f"libcosim does not take {component}.{name} = {value}")
        # an observer costs time at every step, so it is added before the last one
        observer = CosimObserver.CosimObserver.create_last_value()
        good = steps < 2 or execution.step(steps - 1)
        if not (good and execution.add_observer(observer) and execution.step(1)):
            state = CosimEnums.CosimErrorCode(execution.status().error_code).name
            raise RuntimeError(f"libcosim ended with {state}")
        values: Values = {}
        for component, mine in references.items():
            values |= zip(mine, observer.last_real_values(index[component], list(mine.values())), strict=True)
        return values

    return fly


def _readable_copy(course: ExchangeSystem, threads: int) -> Path:
    """Copy the .ssp without content that libcosim cannot read, and add its annotation for step and threads.

    libcosim requires both ends of a connection to be elements, so connections to system connectors are removed. It does
    not read parameter bindings of a system; `prepare` sets their values.
    """
    target = Path(tempfile.mkdtemp(prefix="perilune_libcosim_")) / course.ssp.name
    with zipfile.ZipFile(course.ssp) as source, zipfile.ZipFile(target, "w") as copy:
        for name in source.namelist():
            data = source.read(name)
            copy.writestr(name, _readable(data, course.prepared.step, threads) if name == DESCRIPTION else data)
    return target


def _readable(description: bytes, step: float, threads: int) -> bytes:
    root = etree.fromstring(description)
    for connection in list(root.iter(f"{{{SSD_NAMESPACE}}}Connection")):
        if not {"startElement", "endElement"} <= set(connection.attrib):
            connection.getparent().remove(connection)
    for experiment in list(root.iter(f"{{{SSD_NAMESPACE}}}DefaultExperiment")):
        experiment.getparent().remove(experiment)
    # libcosim reads prefixes, not namespaces, and fails at a declaration inside the annotation
    text = etree.tostring(root, encoding="unicode")
    text = text.replace("SystemStructureDescription ", f'SystemStructureDescription xmlns:osp="{OSP}" ', 1)
    annotation = ANNOTATION.format(step=step, threads=threads)
    experiment = f"<ssd:DefaultExperiment><ssd:Annotations>{annotation}</ssd:Annotations></ssd:DefaultExperiment>"
    end = "</ssd:SystemStructureDescription>"
    if not text.rstrip().endswith(end):
        raise Unavailable("libcosim reads SSDs with the prefix ssd only")
    return text.rstrip().removesuffix(end).encode() + experiment.encode() + end.encode()
