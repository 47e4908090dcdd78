"""System options with their defaults, common to all verbs that simulate; layers of FMUs, parameter sets and values."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Unpack, cast, get_args

from ....common.errors import InputError, suggestion
from ....common.paths import Build
from ...options import simulation_options as declared
from ...options.choices import FUSED, LogLevel
from ...options.option import SetValue, options_of
from ...options.option_values import complete_options

STEP_ROUNDING = 1e-9  # fraction of a step by which a time, a period or a range may deviate from a multiple


# Sources of system options by increasing precedence. The bindings of the system's own description have the lowest
# precedence of all. All parameter sets are applied before all single values.
LAYERS = ("operating_point", "campaign", "draws", "command_line", "study")


@dataclass(frozen=True)
class Layer:
    """Options from a single source.

    ``use`` maps a component to the FMU that replaces its own, by block name or path. ``parameters`` lists parameter
    sets. ``set`` maps ``component.variable`` to a value in SI units, or ``component.vector`` to a value for each
    element. ``places`` maps a name in ``set`` to its file and line, if known.
    """

    use: Mapping[str, str] = field(default_factory=dict)
    parameters: tuple[str, ...] = ()
    set: Mapping[str, SetValue] = field(default_factory=dict)
    places: Mapping[str, tuple[str, int]] = field(default_factory=dict, compare=False)


def _assign(options: Layer | Trust, **fields: object) -> None:
    for name, each in fields.items():
        object.__setattr__(options, name, each)  # fields of a frozen instance are set in its __init__


NETWORK, WRITE = "network", "write="


@dataclass(frozen=True, init=False)
class Trust:
    """Permissions of foreign FMUs, `TrustOptions`: set by the user, never read from a campaign's folder.

    Untrusted FMUs run in a separate process without network access, and may only write to permitted folders. Raises
    InputError.
    """

    trust: declared.TrustOptions = field(default_factory=declared.TrustOptions, compare=False)

    def __init__(self, **options: Unpack[declared.TrustOptions]) -> None:
        _assign(self, trust=complete_options(declared.TrustOptions, options))
        self._check()

    def _check(self) -> None:
        for text in self.trust["allow"]:
            if text != NETWORK and not text.startswith(WRITE):
                raise InputError("`allow`", text, "unknown", f"give {NETWORK}, or {WRITE}FOLDER")
        for folder in self.writable:
            if not os.path.isdir(folder):
                raise InputError("`allow`", folder, "no such folder", "create it, or correct the name")

    @property
    def writable(self) -> tuple[str, ...]:
        """Folders to which foreign FMUs may write."""
        return tuple(text.removeprefix(WRITE) for text in self.trust["allow"] if text != NETWORK)


UNTRUSTED = Trust()
STATED = options_of(declared.SystemKeywords)


class _Keywords(declared.SystemKeywords, total=False):
    """Keyword arguments of `SystemOptions`."""

    folder: str
    trust: declared.TrustOptions
    chosen: declared.ChosenOptions
    limits: declared.LimitOptions


@dataclass(frozen=True, init=False)
class SystemOptions(Trust, Layer):
    """All system options, in the groups of their declaration in `options/simulation_options.py`.

    In ``chosen``, None has these meanings: for ``algorithm``, the algorithm in the system's description, else
    sequential; for ``flavour``, native FMUs if they are built; for ``open_inputs``, ``refuse`` for a system and
    ``start`` for a stand-alone FMU. ``limits`` apply to processes with foreign FMUs. Relative paths are relative to
    ``folder``, since an FMU may change the process's working folder. Trust, limits and folder are ignored when options
    are compared. Raises InputError.
    """

    chosen: declared.ChosenOptions = field(default_factory=declared.ChosenOptions)
    limits: declared.LimitOptions = field(default_factory=declared.LimitOptions, compare=False)
    folder: str = field(default_factory=os.getcwd, compare=False, repr=False)

    def __init__(self, **options: Unpack[_Keywords]) -> None:
        groups: dict[str, Any] = {**options}
        keywords = {name: each for group in GROUPS for name, each in groups.pop(group, {}).items()} | groups
        _assign(self, places=keywords.pop("places", {}), folder=keywords.pop("folder", os.getcwd()))
        unknown = [name for name in keywords if name not in STATED]
        if unknown:
            raise TypeError(f"no system option {unknown[0]!r}; {suggestion(unknown[0], STATED)}")
        _assign(self, **complete_options(declared.LayerOptions, keywords))
        for name, group in GROUPS.items():
            _assign(self, **{name: complete_options(group, keywords)})
        self._check()

    @property
    def build(self) -> Build | None:
        """Build of Perilune's FMUs; None means native FMUs if they are built."""
        flavour = self.chosen["flavour"]
        return None if flavour == FUSED else cast(Build | None, flavour)

    @property
    def by_name(self) -> dict[str, Any]:
        """All options by name, layers first."""
        layer = {name: getattr(self, name) for name in options_of(declared.LayerOptions)}
        return layer | {name: each for group in GROUPS for name, each in getattr(self, group).items()}

    def replace(self, **changes: Unpack[_Keywords]) -> SystemOptions:
        """Return a copy of these options with some changes."""
        return SystemOptions(**cast(_Keywords, {**vars(self), **changes}))

    def merge(self, **layers: Layer) -> SystemOptions:
        """Return these options of the command line, merged with options of other sources by names in `LAYERS`."""
        remaining: dict[str, Layer] = {"command_line": self, **layers}
        ordered = [remaining.pop(name) for name in LAYERS if name in remaining]
        if remaining:
            raise TypeError(f"no such layer: {', '.join(remaining)}")
        merged = {
            "use": {slot: fmu for layer in ordered for slot, fmu in layer.use.items()},
            "parameters": tuple(name for layer in ordered for name in layer.parameters),
            "set": {name: value for layer in ordered for name, value in layer.set.items()},
            "places": _places(ordered),
        }
        return SystemOptions(**cast(_Keywords, {**vars(self), **merged}))


GROUPS: Mapping[str, type] = {  # attribute of `SystemOptions` -> type with its options
    "trust": declared.TrustOptions,
    "chosen": declared.ChosenOptions,
    "limits": declared.LimitOptions,
}


def system_options(options: Mapping[str, Any]) -> SystemOptions:
    """Return the system options among the options of a verb, by name."""
    keywords = {name: options[name] for name in options_of(declared.SystemKeywords) if name in options}
    return SystemOptions(**cast(_Keywords, keywords))


def select_permissions(options: Mapping[str, Any]) -> Trust:
    """Return the permissions of foreign FMUs among the options of a verb."""
    keywords = {name: options[name] for name in options_of(declared.TrustOptions) if name in options}
    return Trust(**cast(declared.TrustOptions, keywords))


def _places(layers: Sequence[Layer]) -> dict[str, tuple[str, int]]:
    """Return the file and line of each value that takes effect, for values whose layer states them."""
    last = {name: layer for layer in layers for name in layer.set}
    return {name: layer.places[name] for name, layer in last.items() if name in layer.places}


LOG_LEVELS: tuple[str, ...] = get_args(LogLevel)
# Least fmi2Status of each level: discard, warning, OK. With `all`, FMUs also log all of their categories.
SAID_FROM = dict(zip(LOG_LEVELS, (2, 1, 0, 0), strict=True))


@dataclass(frozen=True)
class Watch:
    """Supervision of a simulation, which ``timeout`` (s of wall time) ends; ``log`` is the least level of messages.

    Raises InputError for a time that is not positive, and for an unknown level.
    """

    timeout: float | None = None
    log: str | None = None

    def __post_init__(self) -> None:
        if self.timeout is not None and not 0.0 < self.timeout < math.inf:
            raise InputError("`timeout`", str(self.timeout), "not a positive number of seconds", "give more than 0")
        if self.log is not None and self.log not in LOG_LEVELS:
            raise InputError("`log`", self.log, "no such level", suggestion(self.log, LOG_LEVELS))


UNWATCHED = Watch()
