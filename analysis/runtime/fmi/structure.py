"""Structural parameters of a component of FMI 3.0, which determine array sizes and so the names of its variables."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from ....common.errors import InputError
from ..ssp.archive import SystemArchive
from ..ssp.parameter_sets import Assignment, read_binding
from ..ssp.system_description import Binding, Element, SystemDescription, SystemElement


def structural_sizes(
    description: SystemDescription,
    archive: SystemArchive,
    component: str,
    names: Collection[str],
    chosen: Sequence[Assignment],
) -> dict[str, int]:
    """Return the values of the structural parameters of a component, by the component's flat name.

    They are set by the component's bindings, by bindings of the systems around it, and by ``chosen``; later values
    override earlier ones. Raises InputError for a value that is not an integer.
    """
    sizes: dict[str, int] = {}
    for prefix, bindings in _bindings(description.system, component):
        for binding in bindings:
            values, _ = read_binding(archive, description.file, binding, description.units, [])
            sizes |= _sizes(values, prefix, names)
    return sizes | _sizes(chosen, f"{component}.", names)


def _bindings(system: SystemElement, component: str) -> Iterator[tuple[str, list[Binding]]]:
    """Yield bindings from the component outwards, each with the prefix of the component's names in it."""
    owner, remainder = _element(system, component)
    if owner is None:
        return
    if isinstance(owner, SystemElement):
        yield from _bindings(owner, remainder)
    else:
        yield "", owner.bindings
    yield f"{component}.", system.bindings


def _element(system: SystemElement, name: str) -> tuple[Element | None, str]:
    """Return the element of a system with which a flat name begins, and the remainder of the name."""
    for short, element in system.elements.items():
        if name == short or (isinstance(element, SystemElement) and name.startswith(f"{short}.")):
            return element, name[len(short) + 1 :]
    return None, name


def _sizes(assignments: Iterable[Assignment], prefix: str, names: Collection[str]) -> dict[str, int]:
    sizes = {}
    for assignment in assignments:
        name = assignment.name.removeprefix(prefix)
        if assignment.name.startswith(prefix) and name in names:
            try:
                sizes[name] = int(str(assignment.value))
            except ValueError:
                problem = f"{assignment.value!r} is not of type Integer"
                raise InputError(assignment.file, assignment.where, problem, "write a whole number") from None
            if sizes[name] < 0:
                raise InputError(assignment.file, assignment.where, f"{sizes[name]} is negative", "give a size")
    return sizes
