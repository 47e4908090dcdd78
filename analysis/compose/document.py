"""Writer of an SSD (SystemStructureDescription, SSP 1.0) from a `system.toml` and its connections."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from xml.sax.saxutils import quoteattr

from ...common.paths import names_fmu
from ...fmus_src.units import BASE_UNITS
from ..runtime.ssp.conversions import Unit
from ..runtime.ssp.documents import NAMESPACES
from ..runtime.ssp.experiment import STEP_ANNOTATION
from ..runtime.system.fmu import Fmu
from .source import SystemSource
from .units import collect_units
from .values import write_values
from .wiring import ConnectorSource, Point, Wiring

RESOURCES = "resources/"
FMU = 'type="application/x-fmu-sharedlibrary"'
PARAMETER_SET = 'type="application/x-ssp-parameter-set"'
STEP_HINT = "com.opensimulationplatform"
STEP_HINT_NAMESPACE = "http://opensimulationplatform.com/SSP/OSPAnnotations"


def fmu_source(fmu: str) -> str:
    """Return the `source` attribute of a component, from an FMU's name or its path relative to the system's folder."""
    return fmu if names_fmu(fmu) else f"{RESOURCES}{fmu}.fmu"


def set_source(name: str) -> str:
    """Return the `source` of a parameter binding; parameter sets in the system's folder are stored as resources."""
    return name if "/" in name else f"{RESOURCES}{name}"


def write_document(source: SystemSource, fmus: Mapping[str, Fmu], wiring: Wiring) -> bytes:
    """Return the SSD. Raises InputError for a unit without a definition or with conflicting definitions."""
    units = collect_units(source, wiring)
    return b"\n".join([*(line.encode() for line in _head(source, fmus, wiring, units)), *_annotations(source), b""])


def _head(source: SystemSource, fmus: Mapping[str, Fmu], wiring: Wiring, units: Mapping[str, Unit]) -> Iterator[str]:
    name = quoteattr(source.name)
    spaces = [f'    xmlns:{prefix}="{NAMESPACES[prefix]}"' for prefix in ("ssd", "ssc")]
    about = f" description={quoteattr(source.description)}" if source.description else ""
    yield '<?xml version="1.0" encoding="UTF-8"?>'
    yield f'<ssd:SystemStructureDescription version="1.0" name={name}'
    yield from (spaces[0], f"{spaces[1]}>")
    yield f"  <ssd:System name={name}{about}>"
    yield from _connectors(_of("", wiring, _system_order(source, wiring)), "    ")
    yield from _bindings(source.parameters, "    ", write_values(source, fmus, wiring))
    yield "    <ssd:Elements>"
    for component, fmu in fmus.items():
        yield from _component(source, component, fmu, wiring)
    yield "    </ssd:Elements>"
    if wiring.sources:
        yield "    <ssd:Connections>"
        for end, start in wiring.sources.items():
            yield f"      <ssd:Connection {_point('start', start)} {_point('end', end)}/>"
        yield "    </ssd:Connections>"
    yield "  </ssd:System>"
    if units:
        yield "  <ssd:Units>"
        yield from (_unit(units[each]) for each in sorted(units))
        yield "  </ssd:Units>"
    yield from _experiment(source)


def _of(component: str, wiring: Wiring, order: Iterable[str]) -> dict[str, ConnectorSource]:
    return {name: wiring.connectors[component, name] for name in order if (component, name) in wiring.connectors}


def _system_order(source: SystemSource, wiring: Wiring) -> list[str]:
    """Return the system's connectors in the order of their declaration, and elements of an array in index order."""
    names = [name for component, name in wiring.connectors if not component]
    position = {name: index for index, name in enumerate(source.connectors)}
    return sorted(names, key=lambda name: position.get(name, position.get(name.partition("[")[0], 0)))


def _component(source: SystemSource, component: str, fmu: Fmu, wiring: Wiring) -> Iterator[str]:
    stated = source.components[component]
    path = quoteattr(fmu_source(stated.fmu))
    yield f'      <ssd:Component name={quoteattr(component)} {FMU} source={path} implementation="CoSimulation">'
    yield from _connectors(_of(component, wiring, fmu.variables), "        ")
    yield from _bindings(stated.parameters, "        ")
    if stated.step is not None:
        hint = f'<StepSizeHint xmlns="{STEP_HINT_NAMESPACE}" value="{_number(stated.step)}"/>'
        yield f'        <ssd:Annotations><ssc:Annotation type="{STEP_HINT}">{hint}</ssc:Annotation></ssd:Annotations>'
    yield "      </ssd:Component>"


def _connectors(connectors: Mapping[str, ConnectorSource], margin: str) -> Iterator[str]:
    if connectors:
        yield f"{margin}<ssd:Connectors>"
        for name, each in connectors.items():
            unit = f" unit={quoteattr(each.unit.name)}" if each.unit is not None else ""
            head = f'{margin}  <ssd:Connector name={quoteattr(name)} kind="{each.kind}"'
            yield f"{head}><ssc:{each.type}{unit}/></ssd:Connector>"
        yield f"{margin}</ssd:Connectors>"


def _bindings(names: Iterable[str], margin: str, values: Iterable[str] = ()) -> Iterator[str]:
    lines = [f"  <ssd:ParameterBinding {PARAMETER_SET} source={quoteattr(set_source(name))}/>" for name in names]
    if inline := [f"      {line}" for line in values]:
        lines += [f"  <ssd:ParameterBinding {PARAMETER_SET}>", "    <ssd:ParameterValues>", *inline]
        lines += ["    </ssd:ParameterValues>", "  </ssd:ParameterBinding>"]
    if lines:
        lines = ["<ssd:ParameterBindings>", *lines, "</ssd:ParameterBindings>"]
    yield from (margin + line for line in lines)


def _point(side: str, point: Point) -> str:
    component, name = point
    element = f"{side}Element={quoteattr(component)} " if component else ""
    return f"{element}{side}Connector={quoteattr(name)}"


def _unit(unit: Unit) -> str:
    base = [f' {name}="{size}"' for name, size in zip(BASE_UNITS, unit.exponents or (), strict=True) if size]
    base += [f' factor="{_number(unit.factor)}"'] if unit.factor != 1.0 else []
    base += [f' offset="{_number(unit.offset)}"'] if unit.offset else []
    return f"    <ssc:Unit name={quoteattr(unit.name)}><ssc:BaseUnit{''.join(base)}/></ssc:Unit>"


def _experiment(source: SystemSource) -> Iterator[str]:
    stop = "" if source.stop_time is None else f' stopTime="{_number(source.stop_time)}"'
    head = f'  <ssd:DefaultExperiment startTime="{_number(source.start_time)}"{stop}'
    if source.step is None:
        yield f"{head}/>"
        return
    yield f"{head}>"
    yield "    <ssd:Annotations>"
    yield f'      <ssc:Annotation type="{STEP_ANNOTATION}">'
    yield f'        <CommunicationStep xmlns="https://perilune.org/step" size="{_number(source.step)}"/>'
    yield "      </ssc:Annotation>"
    yield "    </ssd:Annotations>"
    yield "  </ssd:DefaultExperiment>"


def _annotations(source: SystemSource) -> list[bytes]:
    end = [b"</ssd:SystemStructureDescription>"]
    return [b"  <ssd:Annotations>" + source.annotations + b"</ssd:Annotations>", *end] if source.annotations else end


def _number(number: float) -> str:
    """Return the shortest text that parses to the same number."""
    return repr(number).removesuffix(".0")
