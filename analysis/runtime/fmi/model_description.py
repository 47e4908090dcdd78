"""Requirements on the modelDescription.xml of an FMU of FMI 3.0, and its elements that FMPy does not read."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Callable

from fmpy.model_description import ModelDescription
from lxml import etree

from ....common.errors import InputError
from ..ssp.fmu_description import FIX, require_attributes
from .representations import REPRESENTATIONS, TEXTS
from .variable import shape

RELEASED = re.compile(r"3\.\d+(\.\d+)?")  # drafts such as 3.0-beta.2 have other functions
MOST_ELEMENTS = 1_000_000  # elements in all arrays of an FMU
SCALAR_REFERENCES = ("Output", "ContinuousStateDerivative", "ClockedState", "InitialUnknown", "EventIndicator")
NUMBERS = ("start", "min", "max", "nominal")


def is_fmi3(version: str | None) -> bool:
    """Return True if an fmiVersion is a released version of FMI 3."""
    return version is not None and RELEASED.fullmatch(version) is not None


def check_description(root: etree._Element, label: str) -> None:
    """Reject an FMU without co-simulation, with clocks, with missing names or references, or with malformed numbers.

    Raises InputError with the FMU's ``label``.
    """
    require_attributes(root, ("modelName", "instantiationToken"), label, _line_of(root))
    interface = root.find("CoSimulation")
    if interface is None:
        kinds = [kind for kind in ("ModelExchange", "ScheduledExecution") if root.find(kind) is not None]
        problem = f"not a co-simulation FMU: its interfaces are {' and '.join(kinds) or 'unknown'}"
        raise InputError(label, "CoSimulation", problem, "export the FMU for co-simulation")
    require_attributes(interface, ("modelIdentifier",), label, _line_of(interface))
    variables = [each for each in root.iterfind("ModelVariables/*") if isinstance(each.tag, str)]
    clock = next((each for each in variables if each.tag == "Clock"), None)
    if clock is not None:
        problem = "is a Clock, and FMUs with clocks are not supported"
        raise InputError(
            label, f"{clock.get('name')} (line {clock.sourceline})", problem, "export the FMU without clocks"
        )
    for element in root.iterfind("TypeDefinitions/*"):
        _check_type(element, label)
    for variable in variables:
        _check_variable(variable, label)
    names = Counter(each.get("name") for each in [*variables, *root.iterfind("ModelVariables/*/Alias")])
    twice = next((name for name, count in names.items() if count > 1), None)
    if twice is not None:
        raise InputError(label, str(twice), "two variables have this name", FIX)
    _check_references(root, variables, label)
    sizes = (("DefaultExperiment", ("startTime", "stopTime", "tolerance", "stepSize")),)
    for path, attributes in (*sizes, ("CoSimulation", ("fixedInternalStepSize",))):
        for element in root.iterfind(path):
            for name in attributes:
                _check_texts(element, name, [element.get(name)], float, "a number", label)


def complete(description: ModelDescription, root: etree._Element) -> None:
    """Add information that FMPy's description lacks: limits of unsigned and typed variables, start values of arrays."""
    elements = {each.get("name"): each for each in root.iterfind("ModelVariables/*")}
    for variable in description.modelVariables:
        element = elements[variable.alias.name if variable.alias is not None else variable.name]
        kind = variable.declaredType
        variable.min = element.get("min", kind.min if kind is not None else None)
        variable.max = element.get("max", kind.max if kind is not None else None)
        if variable.dimensions:
            variable.start = _starts(element) or None


def check_sizes(description: ModelDescription, sizes: dict[int, int], label: str) -> None:
    """Reject arrays with too many elements for an exchange element by element. Raises InputError."""
    total = sum(math.prod(shape(each, sizes)) for each in description.modelVariables if each.dimensions)
    if total > MOST_ELEMENTS:
        problem = f"its arrays have {total} elements, more than the limit of {MOST_ELEMENTS}"
        raise InputError(label, "Dimension", problem, "choose smaller structural parameters")


def _check_type(declared: etree._Element, label: str) -> None:
    for item in declared.iterfind("Item"):
        require_attributes(item, ("name", "value"), label, _line_of(item))
        _check_texts(item, "value", [item.get("value")], int, "an integer", label)
    for name in ("min", "max"):
        _check_texts(declared, name, [declared.get(name)], float, "a number", label)


def _check_variable(variable: etree._Element, label: str) -> None:
    require_attributes(variable, ("name", "valueReference"), label, _line_of(variable))
    tag = str(variable.tag)
    if tag not in REPRESENTATIONS and tag != "Enumeration":
        problem = f"{tag} is not a type of FMI 3.0"
        raise InputError(label, f"{variable.get('name')} (line {variable.sourceline})", problem, FIX)
    _check_texts(variable, "valueReference", [variable.get("valueReference")], _reference, "a value reference", label)
    if tag in TEXTS:
        return
    if tag == "Boolean":
        _check_texts(variable, "start", [*_starts(variable)], _truth, "true or false", label)
        return
    read, kind = (float, "a number") if tag.startswith("Float") else (int, "an integer")
    for name in NUMBERS:
        texts: list[str | None] = [*_starts(variable)] if name == "start" else [variable.get(name)]
        _check_texts(variable, name, texts, read, kind, label)


def _starts(variable: etree._Element) -> list[str]:
    """Return the declared start values: a single value, or a value for each element.

    Values of texts are child elements. The FMU Manipulation Toolbox declares the start values of all arrays as child
    elements.
    """
    texts = [each.get("value", "") for each in variable.iterfind("Start")]
    if variable.tag in TEXTS:
        return texts
    return variable.get("start", " ".join(texts)).split()


def _check_references(root: etree._Element, variables: list[etree._Element], label: str) -> None:
    """Reject undefined value references in lists of dependencies, states or sizes."""
    known = {int(each.get("valueReference", "0")): each for each in variables}
    references = [(each, "valueReference") for each in root.iterfind("ModelVariables/*/Dimension")]
    references += [(each, "derivative") for each in variables]
    for tag in SCALAR_REFERENCES:
        for each in root.iterfind(f"ModelStructure/{tag}"):
            references += [(each, "valueReference"), (each, "dependencies")]
    for element, name in references:
        for text in element.get(name, "").split():
            if not (text.isascii() and text.isdigit() and len(text) < 11 and int(text) in known):
                raise InputError(label, f"{_line_of(element)}, {name}", f"{text[:20]} is not a value reference", FIX)
    for element in root.iterfind("ModelVariables/*/Dimension"):
        start, reference = element.get("start"), element.get("valueReference")
        if start is not None:
            _check_texts(element, "start", [start], _size, "a number of elements", label)
        elif not (reference or "").strip() or known[int(reference)].get("causality") != "structuralParameter":
            raise InputError(label, _line_of(element), "has neither a start nor a structural parameter", FIX)
        elif known[int(reference)].find("Dimension") is not None:
            raise InputError(
                label, _line_of(element), "the structural parameter of its size is an array, not a scalar", FIX
            )
        else:
            _check_texts(
                known[int(reference)],
                "start",
                [known[int(reference)].get("start", "")],
                _size,
                "a number of elements",
                label,
            )


def _check_texts(
    element: etree._Element, name: str, texts: list[str | None], read: Callable[[str], object], kind: str, label: str
) -> None:
    for text in texts:
        try:
            if text is not None:
                read(text)
        except (ValueError, KeyError):
            raise InputError(label, f"{_line_of(element)}, {name}", f"{text!r} is not {kind}", FIX) from None


def _truth(text: str) -> bool:
    return {"true": True, "1": True, "false": False, "0": False}[text.strip()]


def _reference(text: str) -> int:
    reference = int(text)
    if not 0 <= reference < 2**32:
        raise ValueError(text)
    return reference


def _size(text: str) -> int:
    size = int(text)
    if size < 0:
        raise ValueError(text)
    return size


def _line_of(element: etree._Element) -> str:
    name = element.get("name")
    return f"{name or element.tag} (line {element.sourceline})"
