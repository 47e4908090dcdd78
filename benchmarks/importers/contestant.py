"""The system that all contestants fly, packed as one .ssp, and what every way of flying it is to the benchmark."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from perilune.analysis.runtime.ssp.conversions import IDENTITY
from perilune.analysis.runtime.ssp.given_values import ParameterValue
from perilune.analysis.runtime.system.network import Link
from perilune.analysis.runtime.system.prepared import PreparedSystem, prepare_system
from perilune.common.errors import InputError


@dataclass(frozen=True)
class Course:
    """A system whose FMUs exchange Reals as they are, from one component straight to another."""

    ssp: Path

    @cached_property
    def prepared(self) -> PreparedSystem:
        """The system read and checked by our own importer; raises InputError."""
        prepared = prepare_system(self.ssp)
        for link in prepared.network.driver.values():
            if link.target.component is not None and not _is_plain(link):
                raise InputError(
                    prepared.network.file,
                    f"connection {link.source.name} -> {link.target.name} (line {link.line})",
                    "contestants exchange Reals between FMUs without conversion",
                    "benchmark another system",
                )
        return prepared

    def flight(self, steps: int, algorithm: str = "sequential") -> PreparedSystem:
        """Return the system with another number of steps and this algorithm."""
        return replace(self.prepared, steps=steps, algorithm=algorithm)

    @cached_property
    def links(self) -> list[Link]:
        """Connections between FMUs, in the order of the SSD."""
        return [link for link in self.prepared.network.driver.values() if link.target.component is not None]

    @cached_property
    def names(self) -> list[str]:
        """Outputs that another FMU reads: what a flight gives back."""
        return list(dict.fromkeys(link.source.name for link in self.links))

    def settings(self) -> dict[tuple[str, str], ParameterValue]:
        """Return parameter values by component and variable."""
        return dict(self.prepared.settings.variables)


def _is_plain(link: Link) -> bool:
    return (
        link.source.component is not None
        and link.source.type_name == link.target.type_name == "Real"
        and link.target.kind == "input"
        and link.transformation == IDENTITY
        and not link.added
    )


# What the others are compared with, by flavour.
OURS = {"python": "perilune_python", "native": "perilune_native"}
Values = dict[str, float]
Fly = Callable[[int], Values]


class Unavailable(Exception):  # noqa: N818 - not an error: the table says why
    """A contestant that is unavailable here; the text says why and what would help."""


@dataclass(frozen=True)
class Contestant:
    """One way of simulating a system.

    ``flavour`` says which FMUs it uses, ``what`` describes it in one sentence, ``algorithm`` is the one of ours whose
    values it must reproduce (None: its order is none of ours), ``exact`` whether to the last bit. ``prepare`` makes
    ready whatever outlasts a flight and returns a function that flies a number of steps from the start and returns the
    values of ``course.names`` at the end; it raises `Unavailable`.
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
    """Return ways of simulating Python FMUs, then the same of native ones."""
    native = [replace(way, name=f"{way.name.removesuffix('_python')}_native", flavour="native") for way in ways]
    return (*ways, *native)
