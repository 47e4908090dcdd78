"""Writer of a block's modelDescription.xml of FMI 2.0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lxml import etree

from ...block import Block
from ...variables import Output, Parameter, State, Variable
from .common import (
    STATE_ANNOTATION,
    about_enumeration,
    add_items,
    add_log_categories,
    add_units,
    boolean,
    describe,
    enumerations_by_name,
    limits,
    role,
    start_description,
    start_text,
)


def model_description(
    block_class: type[Block],
    *,
    guid: str,
    origin: Mapping[str, str],
    needs_execution_tool: bool,
    sources: Sequence[str] = (),
    native_memory: bool = False,
) -> bytes:
    """Return modelDescription.xml of a block.

    ``origin`` contains the attributes of `origin.origin`. ``sources`` lists the C files under ``sources/`` that an
    importer compiles; ``native_memory`` declares that the FMU uses the importer's memory functions. Value references
    number the elements of all variables in order of declaration. Raises ValueError for two enumerations of the same
    name.
    """
    root = start_description(block_class.fmu_name, guid, block_class.summary(), origin)
    simulation = etree.SubElement(
        root,
        "CoSimulation",
        modelIdentifier=block_class.fmu_name,
        needsExecutionTool=boolean(needs_execution_tool),
        canHandleVariableCommunicationStepSize="true",
        canGetAndSetFMUstate=boolean(not block_class.external),
        canSerializeFMUstate=boolean(not block_class.external),
        canNotUseMemoryManagementFunctions=boolean(not native_memory),
    )
    if sources:
        files = etree.SubElement(simulation, "SourceFiles")
        for name in sources:
            etree.SubElement(files, "File", name=name)
    variables = list(block_class.variables.values())
    add_units(root, variables)
    _add_types(root, variables)
    add_log_categories(root)
    etree.SubElement(root, "DefaultExperiment", startTime="0.0", stepSize=repr(block_class.default_step))
    _state_layout(root, block_class, "json" if needs_execution_tool else "words")
    model_variables = etree.SubElement(root, "ModelVariables")
    indices: dict[str, list[int]] = {}
    reference = 0
    for variable in variables:
        indices[variable.name] = []
        for position, name in enumerate(variable.element_names()):
            about = describe(block_class, variable, variable.descriptions()[position])
            named = {"name": name, "valueReference": str(reference), "description": about}
            _scalar_variable(model_variables, variable, position, named | role(block_class, variable))
            reference += 1
            indices[variable.name].append(reference)  # ScalarVariable indices count from 1
    _structure(root, block_class, indices)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)


def _add_types(root: etree._Element, variables: Sequence[Variable]) -> None:
    """Add a SimpleType for each enumeration."""
    enumerations = enumerations_by_name(root.get("modelName", ""), (each.enumeration for each in variables))
    if enumerations:
        definitions = etree.SubElement(root, "TypeDefinitions")
        for name, enumeration in enumerations.items():
            described = {"name": name, "description": about_enumeration(enumeration)}
            kind = etree.SubElement(etree.SubElement(definitions, "SimpleType", described), "Enumeration")
            add_items(kind, enumeration)


def _scalar_variable(parent: etree._Element, variable: Variable, position: int, attributes: dict[str, str]) -> None:
    element = etree.SubElement(parent, "ScalarVariable", attributes)
    details: dict[str, str] = {}
    if not isinstance(variable, Output | State):
        details["start"] = start_text(variable, [variable.elements[position]])
    unit = variable.units()[position]
    if variable.type_name == "Real" and unit:
        details["unit"] = unit
    if variable.enumeration is not None:
        details["declaredType"] = variable.enumeration.__name__
    etree.SubElement(element, variable.fmi_type, details | limits(variable))


def _state_layout(root: etree._Element, block_class: type[Block], encoding: str) -> None:
    """Declare the memory layout of fmi2SerializeFMUstate, so that analyses can read and change states.

    The layout "words" consists of 6 words of 8 bytes, then one word for every value reference; the layout "json"
    contains a list "values" by value reference. ``frozen`` lists the value references that a linearisation does not
    change. A block with external state is declared as such instead, since its memory is not serialised.
    """
    annotations = etree.SubElement(root, "VendorAnnotations")
    tool = etree.SubElement(annotations, "Tool", name=STATE_ANNOTATION)
    if block_class.external:
        etree.SubElement(tool, "ExternalState", names=" ".join(block_class.external))
        return
    frozen: list[int] = []
    reference = 0
    for variable in block_class.variables.values():
        if isinstance(variable, State):
            flags = enumerate(variable.frozen_elements(), reference)
            frozen += [element for element, is_frozen in flags if is_frozen]
        reference += variable.size
    etree.SubElement(tool, "SerializedState", encoding=encoding, frozen=" ".join(map(str, frozen)))


def _structure(root: etree._Element, block_class: type[Block], indices: dict[str, list[int]]) -> None:
    structure = etree.SubElement(root, "ModelStructure")
    outputs = [variable for variable in block_class.variables.values() if isinstance(variable, Output)]
    parameters = [name for name, variable in block_class.variables.items() if isinstance(variable, Parameter)]
    if not outputs:
        return
    direct = etree.SubElement(structure, "Outputs")
    initial = etree.SubElement(structure, "InitialUnknowns")
    for output in outputs:
        inputs = [index for name in block_class.direct_inputs(output) for index in indices[name]]
        known = [index for name in parameters for index in indices[name]]
        for index in indices[output.name]:
            _unknown(direct, index, inputs)
            _unknown(initial, index, sorted(inputs + known))


def _unknown(parent: etree._Element, index: int, dependencies: list[int]) -> None:
    etree.SubElement(
        parent,
        "Unknown",
        index=str(index),
        dependencies=" ".join(map(str, dependencies)),
        dependenciesKind=" ".join(["dependent"] * len(dependencies)),
    )
