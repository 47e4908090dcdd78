"""Units that a composed system defines: units of its connectors, its annotations and [units]."""

from __future__ import annotations

from ...common.errors import InputError, SeveralProblemsError
from ..runtime.ssp.conversions import Unit, unit_by_name
from ..runtime.ssp.documents import NAMESPACES, parse_xml
from .source import SystemSource
from .wiring import Wiring


def collect_units(source: SystemSource, wiring: Wiring) -> dict[str, Unit]:
    """Return all units by name; units of connectors are defined by their FMUs.

    Raises SeveralProblemsError for units without a definition or with conflicting definitions.
    """
    units = dict(source.units)
    problems: list[InputError] = []
    for (component, name), connector in wiring.connectors.items():
        unit = connector.unit
        if unit is not None and not unit.is_same(units.setdefault(unit.name, unit)):
            where = f"{component}.{name}" if component else name
            known = units[unit.name]
            problem = f"its unit is {unit.differs_from(known)} here and {known.differs_from(unit)} elsewhere"
            problems.append(source.problem(where, problem, "use a different name for each unit"))
    for name in annotation_units(source):
        units.setdefault(name, unit_by_name(name))
        if units[name].exponents is None:
            remedy = f"define it in [units], as {name} = {{ rad = 1, s = -1, factor = 2 }}"
            problems.append(source.problem("annotations", f"unit {name} is not known", remedy))
    if problems:
        raise SeveralProblemsError(*(problem.text for problem in problems))
    return units


def underived_units(source: SystemSource, wiring: Wiring, defined: dict[str, Unit]) -> dict[str, Unit]:
    """Return the units of an SSD that cannot be derived from a connector or from a unit name in an annotation."""
    derived = {each.unit.name: each.unit for each in wiring.connectors.values() if each.unit is not None}
    for name in annotation_units(source):
        derived.setdefault(name, unit_by_name(name))
    return {
        name: unit
        for name, unit in defined.items()
        if name not in derived or derived[name].exponents is None or not unit.is_same(derived[name])
    }


def annotation_units(source: SystemSource) -> list[str]:
    """Return the units named by `unit` attributes in annotations. Raises InputError for malformed XML."""
    if not source.annotations:
        return []
    spaces = "".join(f' xmlns:{prefix}="{NAMESPACES[prefix]}"' for prefix in ("ssd", "ssc"))
    document = f"<ssd:Annotations{spaces}>".encode() + source.annotations + b"</ssd:Annotations>"
    root = parse_xml(document, f"{source.file}: annotations")
    return list(dict.fromkeys(str(element.get("unit")) for element in root.iter("{*}*") if element.get("unit")))
