"""The records of a whole kernel, each of which becomes a struct of C under its name."""

from __future__ import annotations

from .expressions import type_of_variable
from .kernel import Kernel, RecordType, Several


def records_of(kernel: Kernel) -> list[RecordType]:
    """The records that a kernel has, each after those of its fields."""
    ordered: dict[RecordType, None] = {}

    def add(kind: object) -> None:
        for part in kind.parts if isinstance(kind, Several) else [kind]:
            if isinstance(part, RecordType) and part not in ordered:
                for name in part.record.fields:
                    add(part.field(name))
                ordered[part] = None

    for variable in kernel.block_class.variables.values():  # a state may be one that no function reads
        add(type_of_variable(variable))
    for function in kernel.functions:
        for kind in (*function.parameters.values(), *function.locals.values(), *function.types.values()):
            add(kind)
        add(function.returns)
    return list(ordered)


def check_record_names(kernel: Kernel) -> None:
    """Report records of one name, of which C would see one."""
    named: dict[str, type] = {}
    for kind in records_of(kernel):
        record = kind.record
        other = named.setdefault(record.__name__, record)
        if other is not record:
            pair = [f"{one.__module__}.{one.__qualname__}" for one in (other, record)]
            kernel.report_block("record names", first=pair[0], second=pair[1])
