"""Check that a block's kernel is written in the subset of Python that is defined in subset_table.py.

Accepted code runs as plain Python and translates to C99 with identical bits.
"""

from __future__ import annotations

from ...block import Block
from .effects import find_effects
from .expressions import type_of_variable
from .flow import FlowCheck
from .kernel import Kernel, RecordType, Several, Violation
from .ranges import find_ranges
from .typed import typecheck

__all__ = ["SubsetError", "Violation", "analyse_kernel", "check", "records_of"]


class SubsetError(ValueError):
    """Error of a block that cannot be translated; the message lists file, line, violation and remedy."""

    def __init__(self, block_class: type[Block], violations: list[Violation]) -> None:
        lines = "\n".join(f"  {violation}" for violation in violations)
        super().__init__(
            f"{block_class.__name__} is outside the subset of Python that kernels are written in:\n{lines}"
        )
        self.block = block_class.__name__
        self.violations = violations


def check(block_class: type[Block]) -> list[Violation]:
    """Return the violations of the subset in `initialize`, `step` and all functions they reach, by file and line."""
    return sorted(_analyse(block_class).violations, key=lambda violation: (violation.file, violation.line))


def analyse_kernel(block_class: type[Block]) -> Kernel:
    """Return the kernel of a block, ready for translation. Raises `SubsetError` for violations."""
    kernel = _analyse(block_class)
    if kernel.violations:
        raise SubsetError(block_class, check(block_class))
    return kernel


def records_of(kernel: Kernel) -> list[RecordType]:
    """Return the records of a kernel, each after the records of its fields; each becomes a C struct of its name."""
    ordered: dict[RecordType, None] = {}

    def add(kind: object) -> None:
        for part in kind.parts if isinstance(kind, Several) else [kind]:
            if isinstance(part, RecordType) and part not in ordered:
                for name in part.record.fields:
                    add(part.field(name))
                ordered[part] = None

    for variable in kernel.block_class.variables.values():  # a state may be read by no function
        add(type_of_variable(variable))
    for function in kernel.functions:
        for kind in (*function.parameters.values(), *function.locals.values(), *function.types.values()):
            add(kind)
        add(function.returns)
    return list(ordered)


def _analyse(block_class: type[Block]) -> Kernel:
    kernel = Kernel(block_class)
    if block_class.python_only:
        kernel.report_block("python only")
        return kernel
    kernel = typecheck(block_class)
    for function in kernel.functions:
        FlowCheck(kernel, function).check()
    _check_record_names(kernel)
    if not kernel.violations:  # later analyses build on types
        find_ranges(kernel)
        find_effects(kernel)
    return kernel


def _check_record_names(kernel: Kernel) -> None:
    """Report records with the same name, which would be the same struct in C."""
    named: dict[str, type] = {}
    for kind in records_of(kernel):
        record = kind.record
        other = named.setdefault(record.__name__, record)
        if other is not record:
            pair = [f"{one.__module__}.{one.__qualname__}" for one in (other, record)]
            kernel.report_block("record names", first=pair[0], second=pair[1])
