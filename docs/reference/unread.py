"""Parameters that a block never reads but inherits, because other blocks of the same base class read them."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass

from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.judge.tunable import NEVER_READ, OTHER_PYTHON, PYTHON_ONLY, find_fixed


@dataclass(frozen=True)
class Unread:
    """Parameter that a block inherits from the class ``declared_in`` and never reads, and the blocks that read it."""

    name: str
    declared_in: type[Block]
    readers: tuple[str, ...]


def find_unread(block: type[Block]) -> list[Unread]:
    """Return the parameters of a block that none of its executed functions reads."""
    return [_describe(block, name) for name, reason in find_fixed(block).items() if reason == NEVER_READ]


def explain_unread(block: type[Block]) -> str:
    """Return a sentence for each group of unread parameters with the same readers; empty without unread ones."""
    names: dict[tuple[type[Block], tuple[str, ...]], list[str]] = defaultdict(list)
    for each in find_unread(block):
        names[each.declared_in, each.readers].append(f"`{each.name}`")
    return "\n\n".join(
        f"It never reads {', '.join(several)}, which all blocks of `{declared_in.__name__}` have, so that a parameter "
        f"set fits each of them. Read by {', '.join(f'[{reader}]({reader}.md)' for reader in readers)}."
        for (declared_in, readers), several in names.items()
    )


def _describe(block: type[Block], name: str) -> Unread:
    classes = [each for each in block.__mro__ if issubclass(each, Block) and name in each.variables]
    unproved = (NEVER_READ, PYTHON_ONLY, OTHER_PYTHON)
    readers = [
        other.fmu_name
        for other in catalogue().values()
        if issubclass(other, classes[-1]) and name in other.variables and find_fixed(other)[name] not in unproved
    ]
    return Unread(name, classes[-1], tuple(readers))
