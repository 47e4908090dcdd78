"""Requirements on the modelDescription.xml of a simulated FMU; other violations of FMI are reported as flaws."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import fmpy
from lxml import etree

from ....common.errors import InputError
from .documents import check_violations, parse_xml

DESCRIPTION = "modelDescription.xml"
SCHEMAS = Path(fmpy.__file__).parent / "schema"
STATE_ANNOTATION = "org.perilune.state"  # in FMUs that declare how, or that they do not, serialise their memory
MANY_BYTES = 1_000_000  # size of a description that may have many violations
FIX = f"fix the FMU's {DESCRIPTION}"
VARIABLE = "ModelVariables/ScalarVariable"
ITEM = "TypeDefinitions/SimpleType/Enumeration/Item"
REQUIRED = {
    ".": ("modelName", "guid"),
    "CoSimulation": ("modelIdentifier",),
    VARIABLE: ("name", "valueReference"),
    ITEM: ("name", "value"),
}
MAY_BE_EMPTY = ("guid", "instantiationToken")


def _truth(text: str) -> bool:
    return {"true": True, "1": True, "false": False, "0": False}[text.strip()]


NUMBERS: dict[str, tuple[Callable[[str], object], str, tuple[str, ...]]] = {
    "DefaultExperiment": (float, "a number", ("startTime", "stopTime", "tolerance", "stepSize")),
    "CoSimulation": (float, "a number", ("fixedInternalStepSize",)),
    VARIABLE: (int, "an integer", ("valueReference",)),
    ITEM: (int, "an integer", ("value",)),
    f"{VARIABLE}/Real": (float, "a number", ("start", "min", "max", "nominal")),
    f"{VARIABLE}/Integer": (int, "an integer", ("start", "min", "max")),
    f"{VARIABLE}/Enumeration": (int, "an integer", ("start", "min", "max")),
    f"{VARIABLE}/Boolean": (_truth, "true or false", ("start",)),
}  # readers of attributes, if present
INDICES = {"ModelStructure/*/Unknown": ("index", "dependencies"), f"{VARIABLE}/Real": ("derivative",)}


def check_description(root: etree._Element, label: str) -> None:
    """Reject versions other than 2.0, missing and duplicate names, and malformed numbers.

    Raises InputError, with the FMU's ``label``.
    """
    version = root.get("fmiVersion")
    if version != "2.0":
        raise InputError(label, "fmiVersion", f"{version!r} is not supported", "export the FMU for FMI 2.0 or 3.0")
    for path, attributes in REQUIRED.items():
        for element in root.iterfind(path):
            require_attributes(element, attributes, label, _line_of(element))
    for path, (read, kind, attributes) in NUMBERS.items():
        for element in root.iterfind(path):
            for name in attributes:
                _check_number(element, name, read, kind, label)
    _check_indices(root, label)
    names = Counter(variable.get("name") for variable in root.iterfind(VARIABLE))
    twice = next((name for name, count in names.items() if count > 1), None)
    if twice is not None:
        raise InputError(label, str(twice), "two variables have this name", FIX)


def require_attributes(element: etree._Element, names: Sequence[str], label: str, where: str) -> None:
    """Raise InputError, at ``where``, if an attribute of an element is missing, or empty where not permitted."""
    for name in names:
        text = element.get(name)
        if text is None:
            raise InputError(label, where, f"no attribute {name}", FIX)
        if not text and name not in MAY_BE_EMPTY:
            raise InputError(label, where, f"the attribute {name} is empty", FIX)


def check_rules(xml: bytes, version: int, label: str) -> None:
    """Reject a long description with many violations of the schema of FMI 2 or 3, which FMPy would be slow to list."""
    if len(xml) > MANY_BYTES:
        schema = SCHEMAS / f"fmi{version}" / f"fmi{version}ModelDescription.xsd"
        check_violations(etree.XMLSchema(etree.parse(schema)), xml, f"{label}!{DESCRIPTION}")


def external_state_of(xml: bytes) -> tuple[str, ...]:
    """Return the names of a block's external state, which its FMU can neither save nor restore."""
    if b"ExternalState" not in xml:
        return ()
    declared = find_annotation(parse_xml(xml, DESCRIPTION), "ExternalState")
    return () if declared is None else tuple(declared.get("names", "").split())


def find_annotation(root: etree._Element, name: str) -> etree._Element | None:
    """Return an element of Perilune's annotation about an FMU's memory, in FMI 2.0 or 3.0, or None."""
    if root.get("fmiVersion") == "2.0":
        return root.find(f"VendorAnnotations/Tool[@name='{STATE_ANNOTATION}']/{name}")
    return root.find(f"Annotations/Annotation[@type='{STATE_ANNOTATION}']/{{*}}{name}")


def _check_indices(root: etree._Element, label: str) -> None:
    """Reject references, counted from 1, to undefined variables."""
    count = len(root.findall(VARIABLE))
    for path, attributes in INDICES.items():
        for element in root.iterfind(path):
            for name in attributes:
                for text in element.get(name, "").split():
                    if not (text.isascii() and text.isdigit() and len(text) < 10 and 1 <= int(text) <= count):
                        problem = f"{text[:20]} is not the index of one of its {count} variables"
                        raise InputError(label, f"{_line_of(element)}, {name}", problem, FIX)


def _check_number(element: etree._Element, name: str, read: Callable[[str], object], kind: str, label: str) -> None:
    text = element.get(name)
    if text is not None:
        try:
            read(text)
        except (ValueError, KeyError):
            raise InputError(label, f"{_line_of(element)}, {name}", f"{text!r} is not {kind}", FIX) from None


def _line_of(element: etree._Element) -> str:
    return f"{element.tag} (line {element.sourceline})"
