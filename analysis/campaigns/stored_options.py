"""System options in a campaign's manifest, without options that belong to the executing user."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import GenericAlias
from typing import Any, Union, get_args, get_origin

import msgspec

from ...common.errors import InputError
from ..options.choices import OpenInputs
from ..options.option import members_of, options_of
from ..options.simulation_options import SystemKeywords, TrustOptions
from ..runtime.system.options import SystemOptions

REFUSE: OpenInputs = "refuse"
STORED = {name: each for name, each in options_of(SystemKeywords).items() if name not in options_of(TrustOptions)}


def _in_json(annotation: object) -> Any:
    """Return the type of an option in JSON, in which paths are texts."""
    types: list[Any] = []
    for member in members_of(annotation):
        origin, inner = get_origin(member), tuple(map(_in_json, get_args(member)))
        if origin is not os.PathLike:
            types.append(GenericAlias(origin, inner) if origin in (Mapping, Sequence) else member)
    return Union[*types, type(None)] if type(None) in get_args(annotation) else Union[*types]


StoredOptions = msgspec.defstruct(
    "StoredOptions",
    [(name, _in_json(each.annotation), msgspec.field(default=msgspec.UNSET)) for name, each in STORED.items()],
)


def store_options(options: SystemOptions) -> dict[str, Any]:
    """Return the options of a campaign as JSON."""
    stored = {name: setting for name, setting in options.by_name.items() if name in STORED}
    # Native FMUs (the default) and their compiled steps have the same bits: a resumed campaign may change between them.
    stored["flavour"] = "python" if options.chosen["flavour"] == "python" else None
    stored["open_inputs"] = options.chosen["open_inputs"] or REFUSE  # as in folders written before None was permitted
    return stored


def restore_options(stored: Mapping[str, Any], file: Path, remedy: str, *, of_fmu: bool) -> SystemOptions:
    """Return the options in the manifest ``file``, with their types checked. Raises InputError with the ``remedy``.

    Set ``of_fmu`` for the options of a stand-alone FMU.
    """
    unknown = sorted(set(stored) - {*STORED})
    if unknown:
        raise InputError(file, f"options.{unknown[0]}", "not an option of a campaign", remedy)
    try:
        converted = msgspec.convert(dict(stored), StoredOptions)
    except msgspec.ValidationError as error:
        problem, _, element = str(error).partition(" - at ")
        name = f"options.{element.strip('`$.')}".rstrip(".")
        raise InputError(file, name, f"{problem[:1].lower()}{problem[1:]}", remedy) from error
    options = SystemOptions(**{name: getattr(converted, name) for name in stored})
    if of_fmu and options.chosen["open_inputs"] == REFUSE:
        return options.replace(
            open_inputs=None
        )  # other invalid options of a stand-alone FMU were rejected before the manifest was written
    return options
