"""Tables of a system's C source, indexed by value reference: elements, ranges of start values, names."""

from __future__ import annotations

from dataclasses import dataclass

from ....fmus_src.export.write.layout import CodeLines
from ....fmus_src.export.write.tables import write_ranges
from ....fmus_src.start_values import LARGEST
from .choice_statements import quoted
from .fmu_variables import FmuVariable, Variables
from .model import SystemModel


@dataclass(frozen=True)
class StructElement:
    """An element of the system's struct, with its role in the wrapper and the permitted range of its start value."""

    name: str
    path: str
    kind: str
    role: str = "ROLE_STATE"
    range: tuple[float, float] | None = None


def _row_of(each: FmuVariable) -> StructElement:
    """Return the row of a variable declared in modelDescription.xml."""
    within = None
    if each.causality == "parameter":
        within = _range(each.kind, each.minimum, each.maximum)
    elif each.causality == "input":
        within = _range(each.kind, None, None)
    return StructElement(each.name, each.path, each.kind, each.role, within)


def _range(kind: str, minimum: str | None, maximum: str | None) -> tuple[float, float] | None:
    """Return minimum and maximum of a Real, or of an Integer with bounds; None for other types."""
    if kind == "KIND_BOOLEAN" or (kind == "KIND_INTEGER" and minimum is None and maximum is None):
        return None
    return (-LARGEST if minimum is None else float(minimum), LARGEST if maximum is None else float(maximum))


def _list_hidden(model: SystemModel, variables: Variables) -> list[StructElement]:
    """Return the rows of state elements that modelDescription.xml does not declare."""
    declared = {each.path for each in variables.declared}
    faulty = {each.candidate.path_of(each.variable.name) for each in variables.tuned}  # steps compare their values
    hidden = [
        StructElement(
            each.name, each.path, each.kind, range=_range(each.kind, each.variable.minimum, each.variable.maximum)
        )
        for each in variables.tuned
        if each.path not in declared
    ]
    for candidate in model.candidates:
        for variable in candidate.fmu.variables.values():
            if candidate.path_of(variable.name) not in declared:
                name, path = f"{candidate.label}.{variable.name}", candidate.path_of(variable.name)
                kind = candidate.member(variable.name).kind
                is_parameter = variable.causality == "parameter" and path not in faulty
                within = _range(kind, variable.minimum, variable.maximum) if is_parameter else None
                hidden.append(StructElement(name, path, kind, range=within))
        hidden.append(StructElement(f"{candidate.label}, its samples", f"{candidate.identifier}.tick", "KIND_INTEGER"))
    hidden += [
        StructElement(f"signal {name}", f"signal[{constant}]", "KIND_REAL") for name, constant in model.signals.items()
    ]
    for number, name in enumerate(model.faulty):
        hidden.append(StructElement(f"{name}, frozen", f"fault[{number}].frozen", "KIND_REAL"))
        hidden.append(StructElement(f"{name}, kind of the last step", f"fault[{number}].last_kind", "KIND_INTEGER"))
        hidden.append(StructElement(f"{name}, value of the last step", f"fault[{number}].last_value", "KIND_REAL"))
    return [
        *hidden,
        StructElement("start time", "start_time", "KIND_REAL"),
        StructElement("steps", "point", "KIND_INTEGER"),
        StructElement("end", "has_finished", "KIND_BOOLEAN"),
    ]


def write_tables(guid: str, model: SystemModel, variables: Variables) -> str:
    """Return the tables of the wrapper: GUID, and elements by value reference, with undeclared elements last."""
    rows = [*map(_row_of, variables.declared), *_list_hidden(model, variables)]
    lines = CodeLines()
    lines.add(f'#define MODEL_GUID "{guid}"')
    lines.text.append("")
    lines.comment(f"By value reference; those from {len(variables.declared)} on belong to the state alone.")
    lines.open("static const Element ELEMENTS[] = {")
    for row in rows:
        lines.add(f"{{offsetof(Block, {row.path}), {row.kind} | {row.role}, 1}},")
    lines.close("};")
    ranges = write_ranges((number, 1, *row.range) for number, row in enumerate(rows) if row.range is not None)
    lines.text += ["", *ranges, ""]
    lines.comment("For messages.")
    names = ", ".join(quoted(row.name) for row in rows)
    lines.add(f"static const char *const NAMES[] = {{{names}}};")
    return "\n".join([*lines.text, ""])
