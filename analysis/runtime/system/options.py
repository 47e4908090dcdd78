"""What a user may ask of a system, whatever flies it: FMUs in slots, parameters, times, algorithm, limit and log."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

from ....common.errors import InputError, suggestion
from ..ssp.parameter_sets import SetValue

ALGORITHMS = ("sequential", "jacobi")
FUSED = "fused"  # a flavour of flights, of native FMUs
OPEN_INPUTS = ("refuse", "start")
STEP_ROUNDING = 1e-9  # of a step, by which a time, a period or a range may miss whole steps


# Who may ask something of a system, from the lowest to the highest: what a later one says wins. Below all of them
# stands what the system's own description binds. All parameter sets come before all single values.
LAYERS = ("operating_point", "campaign", "draws", "command_line", "study")


@dataclass(frozen=True)
class Layer:
    """What one source asks: ``use`` maps a component to the FMU that takes its place, by block name or path;
    ``parameters`` lists parameter sets; ``set`` maps ``component.variable`` to a value, in SI units, or
    ``component.vector`` to as many as it has elements. ``places`` maps a name of ``set`` to file and line where it is
    written, if it is.
    """

    use: Mapping[str, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()
    set: Mapping[str, SetValue] = field(default_factory=dict)
    places: Mapping[str, tuple[str, int]] = field(default_factory=dict, compare=False)


NETWORK, WRITE = "network", "write="
ISOLATION = ("available", "strict")


@dataclass(frozen=True)
class Trust:
    """What foreign FMUs may do here: options of whoever simulates, never read from a campaign's folder.

    ``in_process``: they are loaded into this process, too, and not into one of their own. There they may not use the
    network, nor write, unless ``allow`` says ``network``, or ``write=FOLDER``. ``isolate``: ``available`` restricts
    them as far as the operating system does, ``strict`` refuses them where it does not. Raises InputError.
    """

    in_process: bool = field(default=False, compare=False)
    allow: tuple[str, ...] = field(default=(), compare=False)
    isolate: str = field(default=ISOLATION[0], compare=False)

    def __post_init__(self) -> None:
        if self.isolate not in ISOLATION:
            raise InputError("`isolate`", self.isolate, "unknown", suggestion(self.isolate, ISOLATION))
        for text in self.allow:
            if text != NETWORK and not text.startswith(WRITE):
                raise InputError("`allow`", text, "unknown", f"give {NETWORK}, or {WRITE}FOLDER")
        for folder in self.writable:
            if not os.path.isdir(folder):
                raise InputError("`allow`", folder, "no such folder", "make it, or correct the name")

    @property
    def writable(self) -> tuple[str, ...]:
        """The folders that foreign FMUs may write to."""
        return tuple(text.removeprefix(WRITE) for text in self.allow if text != NETWORK)

    @property
    def trust(self) -> dict[str, Any]:
        """These options alone, by name."""
        return {each.name: getattr(self, each.name) for each in fields(Trust)}


UNTRUSTED = Trust()


@dataclass(frozen=True)
class SystemOptions(Trust, Layer):
    """What the command line calls system options; see `perilune run --help`.

    Times in s. ``algorithm`` None is what the system's description says, else the first of `ALGORITHMS`. ``flavour``
    None takes native FMUs where they are built, `FUSED` compiles the steps of the system as one function, too.
    ``open_inputs``: what becomes of inputs that nothing drives, ``start`` keeps the FMU's start values; None is
    ``refuse`` in a system and ``start`` of an FMU alone. ``strict``: FMUs whose descriptions break rules of FMI are
    refused and not only remarked upon. ``feedthrough`` are components whose outputs depend directly on all inputs,
    ``no_feedthrough`` those whose outputs depend directly on none. ``call_timeout`` (s), of one call of an FMU, and
    ``memory`` (GB) are limits of processes with foreign FMUs. ``folder`` is what relative paths are meant from: an FMU
    may change the process's working folder once it is loaded.
    """

    step: float | None = None
    stop_time: float | None = None
    algorithm: str | None = None
    variant: str | None = None
    flavour: str | None = None
    allow_unmatched: bool = False
    strict: bool = False
    open_inputs: str | None = None
    feedthrough: tuple[str, ...] = ()
    no_feedthrough: tuple[str, ...] = ()
    call_timeout: float = field(default=300.0, compare=False)
    memory: float = field(default=4.0, compare=False)
    folder: str = field(default_factory=os.getcwd, compare=False, repr=False)

    @property
    def build(self) -> str | None:
        """Which build of Perilune's FMUs is taken; None: native where built."""
        return None if self.flavour == FUSED else self.flavour

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("call_timeout", "memory"):
            limit = getattr(self, name)
            if not 0.0 < limit < math.inf:
                raise InputError(f"`{name}`", str(limit), "not a positive number", "give more than 0")

    def among(self, **layers: Layer) -> SystemOptions:
        """These options, the command line's, with what others ask, by the names of `LAYERS`."""
        remaining: dict[str, Layer] = {"command_line": self, **layers}
        ordered = [remaining.pop(name) for name in LAYERS if name in remaining]
        if remaining:
            raise TypeError(f"no such layer: {', '.join(remaining)}")
        return replace(
            self,
            use={slot: fmu for layer in ordered for slot, fmu in layer.use.items()},
            parameters=tuple(name for layer in ordered for name in layer.parameters),
            set={name: value for layer in ordered for name, value in layer.set.items()},
            places=_places(ordered),
        )


def system_options(options: Mapping[str, Any]) -> SystemOptions:
    """The system options among the options of a verb, by name; FMUs and parameter sets as names or paths."""
    given = {each.name: options[each.name] for each in fields(SystemOptions) if each.name in options}
    return SystemOptions(
        **given
        | {
            "use": {slot: os.fspath(fmu) for slot, fmu in given["use"].items()},
            "allow": tuple(given.get("allow", ())),
            "parameters": tuple(os.fspath(name) for name in given["parameters"]),
        }
    )


def _places(layers: Sequence[Layer]) -> dict[str, tuple[str, int]]:
    """Where each value comes from that is set last, as far as its layer says."""
    last = {name: layer for layer in layers for name in layer.set}
    return {name: layer.places[name] for name, layer in last.items() if name in layer.places}


LOG_LEVELS = ("error", "warning", "info", "all")
# The least fmi2Status of each level: discard, warning, OK; of `all` FMUs are asked for all their categories, too.
SAID_FROM = dict(zip(LOG_LEVELS, (2, 1, 0, 0), strict=True))


def trust_of(options: Mapping[str, Any]) -> Trust:
    """What foreign FMUs may do, among the options of a verb."""
    given = {each.name: options[each.name] for each in fields(Trust) if each.name in options}
    return Trust(**given | {"allow": tuple(given.get("allow", ()))})


@dataclass(frozen=True)
class Watch:
    """``timeout`` (s of the wall clock) ends a flight, ``log`` is the least level of messages that are written.

    Raises InputError for a time that is not positive, and a level that is none.
    """

    timeout: float | None = None
    log: str | None = None

    def __post_init__(self) -> None:
        if self.timeout is not None and not 0.0 < self.timeout < math.inf:
            raise InputError("`timeout`", str(self.timeout), "not a positive number of seconds", "give more than 0")
        if self.log is not None and self.log not in LOG_LEVELS:
            raise InputError("`log`", self.log, "no such level", suggestion(self.log, LOG_LEVELS))


UNWATCHED = Watch()
