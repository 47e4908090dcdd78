"""Checks that a block's kernel is written in the subset of Python that is listed in subset_table.py.

What the check accepts runs as plain Python and translates to C99 with the same bits.
"""

from __future__ import annotations

from ...block import Block
from .effects import find_effects
from .flow import FlowCheck
from .kernel import Kernel, Violation
from .ranges import find_ranges
from .record_types import check_record_names
from .typed import typecheck

__all__ = ["SubsetError", "Violation", "analyse_kernel", "check"]


class SubsetError(ValueError):
    """A block cannot be translated; the message lists file, line, what is refused and what to write instead."""

    def __init__(self, block_class: type[Block], violations: list[Violation]) -> None:
        lines = "\n".join(f"  {violation}" for violation in violations)
        super().__init__(
            f"{block_class.__name__} is outside the subset of Python that kernels are written in:\n{lines}"
        )
        self.block = block_class.__name__
        self.violations = violations


def check(block_class: type[Block]) -> list[Violation]:
    """What `initialize`, `step` and all they reach say that the subset does not have, in order of file and line."""
    return sorted(_analyse(block_class).violations, key=lambda violation: (violation.file, violation.line))


def analyse_kernel(block_class: type[Block]) -> Kernel:
    """The kernel of a block, ready for translation. Raises `SubsetError` where `check` finds something."""
    kernel = _analyse(block_class)
    if kernel.violations:
        raise SubsetError(block_class, check(block_class))
    return kernel


def _analyse(block_class: type[Block]) -> Kernel:
    kernel = Kernel(block_class)
    if block_class.python_only:
        kernel.report_block("python only")
        return kernel
    kernel = typecheck(block_class)
    for function in kernel.functions:
        FlowCheck(kernel, function).check()
    check_record_names(kernel)
    if not kernel.violations:  # later analyses build on types
        find_ranges(kernel)
        find_effects(kernel)
    return kernel
