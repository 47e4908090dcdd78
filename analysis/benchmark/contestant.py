"""What every way of flying a system looks like to the benchmark."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from .course import Course

Values = dict[str, float]
Fly = Callable[[int], Values]


class Unavailable(Exception):  # noqa: N818 - not an error: the table says why
    """A contestant that cannot take part here; the text says why and what would help."""


@dataclass(frozen=True)
class Contestant:
    """One way of flying a system.

    ``flavour`` says which FMUs it flies, ``what`` describes it in one sentence, ``algorithm`` is
    the one of ours whose values it must reproduce (None: it has an order of its own that none of
    ours has), ``exact`` whether to the last bit. ``prepare`` makes ready whatever outlasts a
    flight and returns a function that flies a number of steps from the start and gives the values
    of ``course.names`` at the end; it raises `Unavailable`.
    """

    name: str
    flavour: str
    what: str
    algorithm: str | None
    prepare: Callable[[Course], Fly]
    exact: bool = False

    @property
    def is_ours(self) -> bool:
        return self.name.startswith("perilune")


def both_flavours(*ways: Contestant) -> tuple[Contestant, ...]:
    """Ways of simulating Python FMUs, then the same of native ones."""
    native = [replace(way, name=f"{way.name.removesuffix('_python')}_native", flavour="native") for way in ways]
    return (*ways, *native)
