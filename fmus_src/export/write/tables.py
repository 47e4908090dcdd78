"""Tables of a block's C file for the FMI wrappers: starts, elements, variables, names."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ...block import Block
from ...kernel import vector_types
from ...kernel.records import Record
from ...runtime import POINT_TOLERANCE, SAMPLE_TOLERANCE, STEP_LIMIT, TIME_TOLERANCE
from ...start_values import LARGEST, start_range
from ...variables import Input, Parameter
from ..description.variables import list_variables
from ..judge.tunable import tunable_parameters
from .layout import CodeLines
from .names import identifier, literal, member

KINDS = {float: "KIND_REAL", int: "KIND_INTEGER", bool: "KIND_BOOLEAN"}
TUNABLE = "ROLE_TUNABLE"
ROLES = {"parameter": "ROLE_PARAMETER", "input": "ROLE_INPUT", "output": "ROLE_OUTPUT", "local": "ROLE_STATE"}


def write_tables(block_class: type[Block], type_name: str, guid: str, fmi: int) -> str:
    """Write the wrapper's tables: GUID, declared starts, and variables by value reference."""
    starts = CodeLines()
    starts.open("static const Block STARTS = {")
    elements = CodeLines()
    elements.open("static const Element ELEMENTS[] = {")
    described: list[tuple[str, str]] = []
    tunable = tunable_parameters(block_class)
    for name, variable in block_class.variables.items():
        values = ", ".join(map(literal, variable.elements))
        if variable.record is not None:
            values = _initialise(variable.record.of_elements(variable.elements))
        elif variable.is_array:
            values = f"{{{{{values}}}}}" if variable.is_vector or variable.shape else f"{{{values}}}"
        starts.add(f".{identifier(name)} = {values},")
        kind, role = KINDS[type(variable.elements[0])], TUNABLE if name in tunable else ROLES[variable.causality]
        for position in range(variable.size):
            place, traits = f"offsetof(Block, {member(variable, position)})", f"{kind} | {role}"
            described.append((place, traits))
    starts.close("};")
    for (place, traits), alike in zip(described, _alike([traits for _, traits in described]), strict=True):
        elements.add(f"{{{place}, {traits}, {alike}}},")
    elements.close("};")
    return "\n".join(
        [
            "/* ---- for the FMI wrapper ---- */",
            "",
            f"typedef {type_name} Block;",
            "",
            f'#define MODEL_GUID "{guid}"',
            f"#define SAMPLE_TOLERANCE {SAMPLE_TOLERANCE!r} /* of a sample period */",
            f"#define TIME_TOLERANCE {TIME_TOLERANCE!r} /* of the time */",
            f"#define POINT_TOLERANCE {POINT_TOLERANCE!r} /* of a step */",
            f"#define STEP_LIMIT {STEP_LIMIT} /* samples, and steps of integration, in a communication step */",
            "",
            "/* Declared start values. */",
            *starts.text,
            "",
            "/* In order of declaration. */",
            *elements.text,
            "",
            *_ranges(block_class),
            "",
            *_references(block_class, fmi),
            "",
        ]
    )


def _ranges(block_class: type[Block]) -> list[str]:
    """Return the ranges of Real parameters and inputs, and of Integers with bounds, one row per variable."""
    rows: list[tuple[int, int, float, float]] = []
    first = 0
    for variable in block_class.variables.values():
        if isinstance(variable, Parameter | Input) and variable.type_name != "Boolean":
            low, high = start_range(variable)
            if variable.type_name == "Real" or (low, high) != (-LARGEST, LARGEST):
                rows.append((first, variable.size, low, high))
        first += variable.size
    return write_ranges(rows)


def write_ranges(rows: Iterable[tuple[int, int, float, float]]) -> list[str]:
    """Return the table of ranges: first element, number of elements, least and largest value."""
    lines = CodeLines()
    lines.comment("Of parameters and inputs where a simulation starts.")
    lines.open("static const Range RANGES[] = {")
    for first, count, low, high in rows:
        lines.add(f"{{{first}, {count}, {literal(float(low))}, {literal(float(high))}}},")
    lines.add("{0, 0, 0.0, 0.0},")
    lines.close("};")
    return lines.text


def _references(block_class: type[Block], fmi: int) -> list[str]:
    """Return names by value reference: of elements in FMI 2.0, of variables in FMI 3.0."""
    lines = CodeLines()
    if fmi == 3:
        lines.comment("In order of value references.")
        lines.open("static const Variable VARIABLES[] = {")
        variables = list_variables(block_class)
        for variable in variables:
            columns = (variable.declared.columns or 1) if variable.dimensions else 0
            lines.add(f"{{{variable.first}, {variable.size}, TYPE_{variable.type_name.upper()}, {columns}}},")
        lines.close("};")
        lines.text.append("")
        names = [variable.name for variable in variables]
    else:
        names = [name for variable in block_class.variables.values() for name in variable.element_names()]
    lines.comment("By value reference, for messages.")
    quoted = ", ".join(f'"{name}"' for name in names)
    lines.add(f"static const char *const NAMES[] = {{{quoted}}};")
    return lines.text


def _initialise(start: Any) -> str:
    """Return the C initialiser of a number, vector or record."""
    if isinstance(start, vector_types.Vector):
        return f"{{{{{', '.join(map(literal, start))}}}}}"
    if isinstance(start, Record):
        return f"{{{', '.join(_initialise(getattr(start, name)) for name in start.fields)}}}"
    return literal(start)


def _alike(traits: list[str]) -> list[int]:
    """Count the consecutive elements, from each one on, that have equal traits and are contiguous in the struct."""
    counts: list[int] = []
    for number in range(len(traits) - 1, -1, -1):
        goes_on = counts and traits[number] == traits[number + 1]
        counts.append(counts[-1] + 1 if goes_on else 1)
    return counts[::-1]
