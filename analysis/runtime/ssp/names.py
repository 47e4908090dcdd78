"""Names of signals and parameters, ``component.variable``, taken apart by the components that there are.

A component's name holds dots where systems are nested, and a variable's where its tool names it so
(``motor.speed``): only the components tell where one ends and the other begins.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Set


def split_name(name: str, components: Mapping[str, object] | Set[str]) -> tuple[str, str]:
    """Component and variable of a name, the longest component that fits; empty for the system's own connectors."""
    owner, dot, _ = name.rpartition(".")
    while dot and owner not in components:
        owner, dot, _ = owner.rpartition(".")
    return (owner, name[len(owner) + 1 :]) if dot else ("", name)


def vectors(names: Iterable[str]) -> list[str]:
    """The names of vectors among those of elements: ``plant.position`` for ``plant.position[1]``."""
    return list(dict.fromkeys(name.removesuffix("[1]") for name in names if name.endswith("[1]")))


def elements(name: str, known: Container[str]) -> list[str]:
    """The known names that one stands for: its own, or name[1], name[2] ... of a vector; none where it is unknown."""
    if name in known:
        return [name]
    names: list[str] = []
    while f"{name}[{len(names) + 1}]" in known:
        names.append(f"{name}[{len(names) + 1}]")
    return names
