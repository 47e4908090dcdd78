"""What a child may do and take, by the options of whoever simulates."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from pathlib import Path

from ....common.errors import InputError
from ..system.fmu import Fmu
from ..system.options import NETWORK, SystemOptions
from .servers import Limits
from .system.restriction import Restriction, find_missing

GB = 1e9  # bytes


def limits_for(fmus: Iterable[Fmu], options: SystemOptions) -> Limits:
    """What a child with these FMUs may take and do. Raises InputError."""
    return Limits(round(options.memory * GB), _restriction_for(fmus, options))


def _restriction_for(fmus: Iterable[Fmu], options: SystemOptions) -> Restriction | None:
    """Return what foreign FMUs may do in their child, None where all are our own; they may write to its own files.

    Warns where the operating system lacks something for it, or raises InputError where that is asked for.
    """
    foreign = [fmu for fmu in fmus if not fmu.is_own]
    if not foreign:
        return None
    missing = find_missing()
    if missing and options.isolate == "strict":
        raise InputError("`isolate`", options.isolate, "; ".join(missing), "leave it out, or take another system")
    if missing:
        warnings.warn(f"foreign FMUs are not restricted here: {'; '.join(missing)}", stacklevel=2)
    allowed = [str(Path(options.folder, folder)) for folder in options.writable]
    return Restriction(tuple(allowed), network=NETWORK in options.allow)
