"""Names of signals and parameters, ``component.variable``, split with the known components.

Component names contain dots if systems are nested, and some tools put dots into variable names (``motor.speed``): only
the list of components tells where the component's name ends.
"""

from __future__ import annotations

import itertools
from collections.abc import Container, Iterable, Mapping, Set

MOST_DIMENSIONS = 6  # of an array for which a single name stands


def split_name(name: str, components: Mapping[str, object] | Set[str]) -> tuple[str, str]:
    """Return component and variable of a name, with the longest matching component, or "" for the system itself."""
    owner, dot, _ = name.rpartition(".")
    while dot and owner not in components:
        owner, dot, _ = owner.rpartition(".")
    return (owner, name[len(owner) + 1 :]) if dot else ("", name)


def vectors(names: Iterable[str]) -> list[str]:
    """Return the names of vectors from names of their elements: ``plant.position`` from ``plant.position[1]``."""
    return list(dict.fromkeys(name.removesuffix("[1]") for name in names if name.endswith("[1]")))


def elements(name: str, known: Container[str]) -> list[str]:
    """Return the known names that a name stands for; an empty list if it is unknown.

    A name stands for itself, or for the elements name[1], name[2] ... of a vector, or name[1,1], name[1,2] ... of a
    matrix in row-major order.
    """
    return [name] if name in known else _list_indexed(f"{name}[", known, MOST_DIMENSIONS)


def _list_indexed(start: str, known: Container[str], dimensions: int) -> list[str]:
    """Return the known names that begin with ``start`` and have this many indices, counted from 1, row by row."""
    names: list[str] = []
    for index in itertools.count(1):
        if f"{start}{index}]" in known:
            names.append(f"{start}{index}]")
            continue
        row = _list_indexed(f"{start}{index},", known, dimensions - 1) if dimensions > 1 else []
        if not row:
            return names
        names += row
    return names
