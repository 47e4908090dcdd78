"""Arrays and enumerations among the variables of an FMU, from its modelDescription.xml."""

from __future__ import annotations

from lxml import etree

from ..dimensions import Shape
from ..documents import tag

SCALAR = "ModelVariables/ScalarVariable"


def arrays_of_fmu(description: etree._Element) -> dict[str, Shape]:
    """Return the shapes of the arrays of an FMU of FMI 3.0, with the declared start sizes; empty for FMI 2.0."""
    if not description.get("fmiVersion", "").startswith("3."):
        return {}
    variables = description.findall("ModelVariables/*")
    starts = {variable.get("valueReference"): variable.get("start", "0") for variable in variables}
    shapes: dict[str, Shape] = {}
    for variable in variables:
        dimensions = [inner for inner in variable if tag(inner) == "Dimension"]
        if dimensions:
            sizes = [
                declared.get("start") or starts.get(declared.get("valueReference"), "0") for declared in dimensions
            ]
            shapes[variable.get("name", "")] = tuple(map(int, sizes))
    return shapes


def enumerations_of_fmu(description: etree._Element) -> set[str]:
    """Return the names of an FMU's variables of type Enumeration."""
    declared = [*description.iterfind("ModelVariables/Enumeration"), *description.iterfind(f"{SCALAR}[Enumeration]")]
    return {variable.get("name", "") for variable in declared}
