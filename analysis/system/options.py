"""What a user may ask of a system, whatever flies it: FMUs in slots, parameters, times, algorithm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from .parameter_sets import ParameterValue

ALGORITHMS = ("sequential", "jacobi")
FLAVOURS = ("native", "python")


@dataclass(frozen=True)
class SystemOptions:
    """What the command line calls system options; see `perilune run --help`.

    ``use`` maps a component to the FMU that takes its place, by block name or path; ``set`` maps
    ``component.variable`` to a value, in SI units; times in s. ``flavour`` None takes native FMUs
    where they are built.
    """

    use: Mapping[str, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()
    set: Mapping[str, ParameterValue] = field(default_factory=dict)
    step: float | None = None
    stop_time: float | None = None
    algorithm: str = "sequential"
    variant: str | None = None
    flavour: str | None = None
    allow_unmatched: bool = False
    no_feedthrough: tuple[str, ...] = ()
