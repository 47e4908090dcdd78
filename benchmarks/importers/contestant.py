"""System that all contestants simulate, packed as one .ssp, and the common interface of the contestants."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from perilune.analysis.runtime.ssp.conversions import IDENTITY
from perilune.analysis.runtime.ssp.parameter_values import ParameterValue
from perilune.analysis.runtime.system.network import NodeLink
from perilune.analysis.runtime.system.prepared import PreparedSystem, prepare_system
from perilune.common.errors import InputError


@dataclass(frozen=True)
class ExchangeSystem:
    """System whose FMUs exchange Reals without conversion, directly between components."""

    ssp: Path

    @cached_property
    def prepared(self) -> PreparedSystem:
        """The system as prepared by Perilune. Raises InputError."""
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
        """Return the prepared system with another number of steps and this algorithm."""
        return replace(self.prepared, steps=steps, algorithm=algorithm)

    @cached_property
    def links(self) -> list[NodeLink]:
        """Connections between FMUs, in the order of the SSD."""
        return [link for link in self.prepared.network.driver.values() if link.target.component is not None]

    @cached_property
    def names(self) -> list[str]:
        """Outputs that another FMU reads, whose values a simulation returns."""
        return list(dict.fromkeys(link.source.name for link in self.links))

    def settings(self) -> dict[tuple[str, str], ParameterValue]:
        """Return parameter values by component and variable."""
        return dict(self.prepared.settings.variables)


def _is_plain(link: NodeLink) -> bool:
    return (
        link.source.component is not None
        and link.source.type_name == link.target.type_name == "Real"
        and link.target.kind == "input"
        and link.transformation == IDENTITY
        and not link.added
    )


# Reference of the comparison, by flavour.
OURS = {"python": "perilune_python", "native": "perilune_native"}
Values = dict[str, float]
Fly = Callable[[int], Values]


class Unavailable(Exception):  # noqa: N818 - not an error: the table says why
    """Error of a contestant that is not available on this machine; the text states the reason and a remedy."""


@dataclass(frozen=True)
class Contestant:
    """Contestant: a way to simulate a system.

    ``flavour`` is the build of its FMUs, and ``what`` a description in one sentence. ``algorithm`` is Perilune's
    algorithm whose values the contestant must reproduce, None if it uses a different order; ``exact`` requires equality
    to the last bit. ``prepare`` creates everything that outlasts a simulation and returns a function that simulates a
    number of steps from the start and returns the final values of ``course.names``; it raises `Unavailable`.
    """

    name: str
    flavour: str
    what: str
    algorithm: str | None
    prepare: Callable[[ExchangeSystem], Fly]
    exact: bool = False

    @property
    def is_ours(self) -> bool:
        return self.name.startswith("perilune")


def both_flavours(*ways: Contestant) -> tuple[Contestant, ...]:
    """Return contestants for Python FMUs, then for native FMUs."""
    native = [replace(way, name=f"{way.name.removesuffix('_python')}_native", flavour="native") for way in ways]
    return (*ways, *native)
