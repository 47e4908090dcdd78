"""Writer of modelDescription.xml of FMI 2.0 for a system of blocks."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from lxml import etree

from ...units import UnitDefinition
from .common import add_log_categories, define_units, literal, one_line, start_description

NAME = r"[A-Za-z_]\w*(?:\[\d+(?:,\d+)*\])?"
STRUCTURED = re.compile(rf"{NAME}(?:\.{NAME})*", re.ASCII)  # FMI 2.0.4, 2.2.9, without derivatives and quoted names


@dataclass(frozen=True)
class EnumerationMember:
    """Member of an enumeration; ``meaning`` is empty if its component does not describe it."""

    name: str
    number: int
    meaning: str = ""


@dataclass(frozen=True)
class EnumerationType:
    """Type of an enumeration; types with equal name, description and members are the same type."""

    name: str
    members: tuple[EnumerationMember, ...]
    description: str = ""

    @property
    def numbers(self) -> dict[str, int]:
        """Numbers of the members by name."""
        return {member.name: member.number for member in self.members}


def numbered_type(name: str, labels: Sequence[str], first: int) -> EnumerationType:
    """Return a type with members without meaning, numbered from ``first``."""
    return EnumerationType(name, tuple(EnumerationMember(each, number) for number, each in enumerate(labels, first)))


@dataclass(frozen=True)
class SystemVariable:
    """Variable of FMI 2.0; ``start`` is None if calculated, ``enumeration`` None unless the type is Enumeration."""

    name: str
    causality: str
    type: str
    description: str
    start: float | int | bool | None = None
    unit: str | None = None
    minimum: str | None = None
    maximum: str | None = None
    enumeration: EnumerationType | None = None
    tunable: bool = False  # of a parameter


def system_description(
    name: str,
    description: str,
    variables: Sequence[SystemVariable],
    dependencies: Mapping[str, Sequence[str]],
    *,
    guid: str,
    origin: Mapping[str, str],
    experiment: Mapping[str, float],
    sources: Sequence[str],
    units: Mapping[str, UnitDefinition],
) -> bytes:
    """Return modelDescription.xml; value references number the ``variables`` in order.

    ``dependencies`` contains the inputs on which each output depends directly, ``origin`` the attributes of
    `origin.origin`, ``experiment`` the attributes of DefaultExperiment, and ``units`` the unit definitions of the
    system.
    """
    convention = "structured" if all(STRUCTURED.fullmatch(each.name) for each in variables) else "flat"
    root = start_description(name, guid, one_line(description), origin, convention)
    simulation = etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=name,
        needsExecutionTool="false",
        canHandleVariableCommunicationStepSize="false",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
        canNotUseMemoryManagementFunctions="true",
    )
    files = etree.SubElement(simulation, "SourceFiles")
    for source in sources:
        etree.SubElement(files, "File", name=source)
    define_units(root, (each.unit for each in variables if each.unit), units)
    types = _name_types(variables)
    _add_types(root, types)
    add_log_categories(root)
    etree.SubElement(root, "DefaultExperiment", {key: repr(number) for key, number in experiment.items()})
    listed = etree.SubElement(root, "ModelVariables")
    for reference, variable in enumerate(variables):
        _add_variable(listed, variable, reference, types)
    _add_structure(root, variables, dependencies)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def _name_types(variables: Sequence[SystemVariable]) -> dict[EnumerationType, str]:
    """Return the types of the variables, under unique names that no variable has (FMI 2.0.4, section 2.2.3)."""
    used = {each.name for each in variables}
    names: dict[EnumerationType, str] = {}
    for enumeration in dict.fromkeys(each.enumeration for each in variables if each.enumeration is not None):
        name, number = enumeration.name, 2
        while name in used:
            name, number = f"{enumeration.name}_{number}", number + 1
        used.add(name)
        names[enumeration] = name
    return names


def _add_types(root: etree._Element, types: Mapping[EnumerationType, str]) -> None:
    definitions = etree.SubElement(root, "TypeDefinitions") if types else None
    for enumeration, name in types.items():
        about = {"description": enumeration.description} if enumeration.description else {}
        kind = etree.SubElement(etree.SubElement(definitions, "SimpleType", {"name": name} | about), "Enumeration")
        for member in enumeration.members:
            meaning = {"description": member.meaning} if member.meaning else {}
            etree.SubElement(kind, "Item", {"name": member.name, "value": str(member.number)} | meaning)


def _add_variable(
    parent: etree._Element, variable: SystemVariable, reference: int, types: Mapping[EnumerationType, str]
) -> None:
    attributes = {"name": variable.name, "valueReference": str(reference)}
    attributes |= {"description": one_line(variable.description), "causality": variable.causality}
    attributes["variability"] = "continuous" if variable.type == "Real" else "discrete"
    if variable.causality == "parameter":
        attributes["variability"] = "tunable" if variable.tunable else "fixed"
        attributes["initial"] = "exact"
    elif variable.causality != "input":
        attributes["initial"] = "calculated"
    element = etree.SubElement(parent, "ScalarVariable", attributes)
    details = {} if variable.enumeration is None else {"declaredType": types[variable.enumeration]}
    details |= {} if variable.start is None else {"start": literal(variable.start)}
    details |= {"unit": variable.unit} if variable.unit else {}
    details |= {} if variable.minimum is None else {"min": variable.minimum}
    details |= {} if variable.maximum is None else {"max": variable.maximum}
    etree.SubElement(element, variable.type, details)


def _add_structure(
    root: etree._Element, variables: Sequence[SystemVariable], dependencies: Mapping[str, Sequence[str]]
) -> None:
    structure = etree.SubElement(root, "ModelStructure")
    indices = {each.name: index for index, each in enumerate(variables, 1)}
    outputs = [each.name for each in variables if each.causality == "output"]
    if not outputs:
        return
    listed, initial = etree.SubElement(structure, "Outputs"), etree.SubElement(structure, "InitialUnknowns")
    for name in outputs:
        inputs = sorted(indices[each] for each in dependencies.get(name, ()))
        attributes = {"dependencies": " ".join(map(str, inputs))}
        attributes["dependenciesKind"] = " ".join(["dependent"] * len(inputs))
        etree.SubElement(listed, "Unknown", {"index": str(indices[name])} | attributes)
        etree.SubElement(initial, "Unknown", index=str(indices[name]))  # depends on all knowns
