"""System options as keywords of a function, for `SystemOptions`."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from ..common.errors import InputError
from ..runtime.ssp.parameter_sets import SetValue
from ..runtime.system.options import SystemOptions

FilePath = str | os.PathLike[str]
Compared = Mapping[str, FilePath | Sequence[FilePath]]


def system_options(
    use: Mapping[str, FilePath] | None,
    parameters: Sequence[FilePath],
    set: Mapping[str, SetValue] | None,
    feedthrough: Sequence[str],
    no_feedthrough: Sequence[str],
    **others: Any,
) -> SystemOptions:
    """The options of a call; ``others`` are the rest of `SystemOptions` by name. Raises InputError."""
    check_list("parameters", parameters)
    check_list("feedthrough", feedthrough)
    check_list("no_feedthrough", no_feedthrough)
    return SystemOptions(
        use={slot: os.fspath(fmu) for slot, fmu in (use or {}).items()},
        parameters=tuple(os.fspath(name) for name in parameters),
        set=dict(set or {}),
        feedthrough=tuple(feedthrough),
        no_feedthrough=tuple(no_feedthrough),
        **others,
    )


def compared(compare: Compared | None) -> dict[str, list[str]] | None:
    """The FMUs of each slot that is compared, names or paths; one alone stands for a list of one."""
    if compare is None:
        return None
    return {
        slot: [os.fspath(fmus)] if isinstance(fmus, str | os.PathLike) else [os.fspath(fmu) for fmu in fmus]
        for slot, fmus in compare.items()
    }


def path_list(given: Sequence[FilePath | Sequence[FilePath]]) -> list[str]:
    """Paths of a call that takes them one by one, or as a list."""
    found: list[str] = []
    for entry in given:
        found += [os.fspath(entry)] if isinstance(entry, str | os.PathLike) else [os.fspath(path) for path in entry]
    return found


def check_list(name: str, given: Sequence[object]) -> None:
    """Refuse one text where several are meant, which Python takes for its letters. Raises InputError."""
    if isinstance(given, str | os.PathLike):
        text = os.fspath(given)
        raise InputError(name, text, "one name where a list is meant", f'give {name}=["{text}"]')
