"""Tables of a block's declared variables: connectors, parameters, states."""

from __future__ import annotations

from perilune.fmus_src.block import Block
from perilune.fmus_src.evidence.variable_text import bounds_text, sized_name, start_text, unit_text
from perilune.fmus_src.export.judge.tunable import find_fixed
from perilune.fmus_src.kernel.records import Field, Record, count_numbers
from perilune.fmus_src.variables import Input, Output, Parameter, State, Variable

from .markdown import escaped, table


def declared(block: type[Block], kind: type[Variable]) -> list[Variable]:
    """Return the block's variables of one kind, in order of declaration."""
    return [variable for variable in block.variables.values() if isinstance(variable, kind)]


def inputs(block: type[Block]) -> str:
    """Return the table of the block's inputs, without empty columns.

    This and the other tables are empty texts if they have no rows.
    """
    rows = [
        [*_name(variable), *_range(variable), _frame(variable), _words(variable)] for variable in declared(block, Input)
    ]
    return _filled(["input", "type", "unit", "bounds", "frame", "description"], rows)


def outputs(block: type[Block]) -> str:
    """Return the table of the block's outputs, with the inputs of the same communication point that each depends on."""
    rows = [
        [*_name(variable), *_range(variable), _frame(variable), _at_once(block, variable),
         _words(variable)]
        for variable in declared(block, Output)
    ]  # fmt: skip
    return _filled(["output", "type", "unit", "bounds", "frame", "direct from", "description"], rows)


def parameters(block: type[Block]) -> str:
    """Return the table of the block's parameters: default, bounds, tunability."""
    rows = [
        [
            f"`{sized_name(variable)}`",
            _words(variable),
            variable.fmi_type,
            start_text(variable),
            *_range(variable),
            _frame(variable),
            _in_flight(block, variable),
        ]
        for variable in declared(block, Parameter)
    ]
    return _filled(
        ["parameter", "description", "type", "default", "unit", "bounds", "frame", "during a simulation"], rows
    )


def states(block: type[Block]) -> str:
    """Return the table of the block's states."""
    rows = []
    for variable in declared(block, State):
        if variable.record is None:
            rows.append(
                [
                    *_name(variable),
                    escaped(unit_text(variable)),
                    bounds_text(variable),
                    _frame(variable),
                    _words(variable),
                ]
            )
            continue
        for name, field in _record_fields(variable.record, variable.name):
            size = count_numbers(field.kind)
            label = f"`{name}{f'[{size}]' if size > 1 else ''}`"
            words = escaped(field.description)
            rows.append([label, "Real", escaped(field.unit or "1"), "", escaped(field.frame or ""), words])
    return _filled(["state", "type", "unit", "bounds", "frame", "description"], rows)


def enumerations(block: type[Block]) -> str:
    """Return a table of values for each enumeration among inputs, outputs and parameters."""
    tables = []
    for variable in block.variables.values():
        if variable.enumeration is None or isinstance(variable, State):
            continue
        names, meanings = variable.enumeration.names, variable.enumeration.meanings
        rows = [[str(number), f"`{name}`", escaped(meanings[number])] for number, name in names.items()]
        tables.append(f"`{variable.name}`:\n\n" + table(["value", "name", "meaning"], rows))
    return "\n\n".join(tables)


def _record_fields(record: type[Record], prefix: str) -> list[tuple[str, Field]]:
    """Return name and field of each non-record field of a record, including those of nested records."""
    fields: list[tuple[str, Field]] = []
    for name, field in record.fields.items():
        label = f"{prefix}.{name}"
        if isinstance(field.kind, type) and issubclass(field.kind, Record):
            fields += _record_fields(field.kind, label)
        else:
            fields.append((label, field))
    return fields


def _filled(head: list[str], rows: list[list[str]]) -> str:
    """Return a table without empty columns; an empty text without rows."""
    retained = [index for index in range(len(head)) if any(row[index] for row in rows)]
    return (
        table([head[index] for index in retained], [[row[index] for index in retained] for row in rows]) if rows else ""
    )


def _name(variable: Variable) -> list[str]:
    return [f"`{sized_name(variable)}`", variable.fmi_type]


def _range(variable: Variable) -> list[str]:
    return [escaped(unit_text(variable)), bounds_text(variable)]


def _frame(variable: Variable) -> str:
    return escaped(variable.frame or "")


def _in_flight(block: type[Block], variable: Variable) -> str:
    """Return ``tunable``, or the reason why the parameter is fixed; empty for an interface, whose blocks differ."""
    if block.is_interface:
        return ""
    reason = find_fixed(block)[variable.name]
    return "tunable" if reason is None else f"fixed: {escaped(reason)}"


def _words(variable: Variable) -> str:
    """Return a variable's description without the members of an enumeration, which have a separate section."""
    if variable.enumeration is None:
        return escaped(variable.description)
    return escaped(variable.description.partition(f": {min(variable.enumeration.meanings)} ")[0])


def _at_once(block: type[Block], variable: Variable) -> str:
    assert isinstance(variable, Output)
    names = block.direct_inputs(variable)
    if names and len(names) == len(declared(block, Input)):
        return "all inputs"
    return ", ".join(f"`{name}`" for name in names)
