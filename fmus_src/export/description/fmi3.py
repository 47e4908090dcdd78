"""Writer of a block's modelDescription.xml of FMI 3.0."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from ...block import Block
from ...variables import Output, Parameter, State
from .common import (
    STATE_ANNOTATION,
    about_enumeration,
    add_items,
    add_log_categories,
    add_units,
    describe,
    enumerations_by_name,
    limits,
    role,
    start_text,
)
from .variables import TIME, ArrayVariable, list_variables

FMI_VERSION = "3.0"  # for all of 3.0.x, as returned by fmi3GetVersion


def model_description(block_class: type[Block], *, token: str, origin: Mapping[str, str]) -> bytes:
    """Return modelDescription.xml of a block's native FMU for co-simulation.

    ``origin`` contains the attributes of `origin.origin`. Value references number the variables, one per array, in
    order of declaration; the last is time. Raises ValueError for a variable ``time``, and for two enumerations of the
    same name.
    """
    root = etree.Element(
        "fmiModelDescription",
        fmiVersion=FMI_VERSION,
        modelName=block_class.fmu_name,
        instantiationToken=token,
        description=block_class.summary(),
        variableNamingConvention="structured",
        **origin,
    )
    etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=block_class.fmu_name,
        needsExecutionTool="false",
        canGetAndSetFMUState="true",
        canSerializeFMUState="true",
        canHandleVariableCommunicationStepSize="true",
    )
    variables = list_variables(block_class)
    add_units(root, block_class.variables.values())
    _add_types(root, variables)
    add_log_categories(root)
    etree.SubElement(root, "DefaultExperiment", startTime="0.0", stepSize=repr(block_class.default_step))
    model_variables = etree.SubElement(root, "ModelVariables")
    for variable in variables:
        about = describe(block_class, variable.declared, variable.description)
        _add_variable(model_variables, variable, {"description": about} | role(block_class, variable.declared))
    etree.SubElement(
        model_variables,
        "Float64",
        name=TIME,
        valueReference=str(len(variables)),
        description="simulation time",
        causality="independent",
        variability="continuous",
    )
    _add_structure(root, block_class, variables)
    _add_state_layout(root, variables)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def _add_types(root: etree._Element, variables: list[ArrayVariable]) -> None:
    """Add an EnumerationType for each enumeration."""
    enumerations = enumerations_by_name(root.get("modelName", ""), (variable.enumeration for variable in variables))
    if enumerations:
        definitions = etree.SubElement(root, "TypeDefinitions")
        for name, enumeration in enumerations.items():
            attributes = {"name": name, "description": about_enumeration(enumeration)}
            add_items(etree.SubElement(definitions, "EnumerationType", attributes), enumeration)


def _add_variable(parent: etree._Element, variable: ArrayVariable, attributes: dict[str, str]) -> None:
    declared = variable.declared
    attributes = {"name": variable.name, "valueReference": str(variable.reference)} | attributes
    if variable.enumeration:
        attributes["declaredType"] = variable.enumeration.__name__
    elif variable.type_name == "Float64" and variable.unit:
        attributes["unit"] = variable.unit
    if not isinstance(declared, Output | State):
        attributes["start"] = start_text(declared, variable.starts)
    element = etree.SubElement(parent, variable.type_name, attributes | limits(declared))
    for length in variable.dimensions:
        etree.SubElement(element, "Dimension", start=str(length))


def _add_structure(root: etree._Element, block_class: type[Block], variables: list[ArrayVariable]) -> None:
    structure = etree.SubElement(root, "ModelStructure")
    references = {variable.name: variable.reference for variable in variables}  # no connector is a record
    parameters = [v.reference for v in variables if isinstance(v.declared, Parameter)]
    outputs = [(v.reference, v.declared) for v in variables if isinstance(v.declared, Output)]
    direct = {
        reference: [references[name] for name in block_class.direct_inputs(declared)]
        for reference, declared in outputs
        if isinstance(declared, Output)
    }
    for reference, inputs in direct.items():
        _add_unknown(structure, "Output", reference, inputs)
    for reference, inputs in direct.items():
        _add_unknown(structure, "InitialUnknown", reference, sorted(inputs + parameters))


def _add_unknown(parent: etree._Element, kind: str, reference: int, dependencies: list[int]) -> None:
    etree.SubElement(
        parent,
        kind,
        valueReference=str(reference),
        dependencies=" ".join(map(str, dependencies)),
        dependenciesKind=" ".join(["dependent"] * len(dependencies)),
    )


def _add_state_layout(root: etree._Element, variables: list[ArrayVariable]) -> None:
    """Declare the memory layout of fmi3SerializeFMUState, so that analyses can read and change states.

    It consists of 6 words of 8 bytes, then one word for every element of the variables except time, in order of value
    references; ``frozen`` lists the value references that a linearisation does not change.
    """
    annotations = etree.SubElement(root, "Annotations")
    annotation = etree.SubElement(annotations, "Annotation", type=STATE_ANNOTATION)
    frozen = " ".join(str(variable.reference) for variable in variables if variable.frozen)
    etree.SubElement(annotation, "SerializedState", encoding="words", frozen=frozen)
