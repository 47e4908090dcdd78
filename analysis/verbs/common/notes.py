"""Notes on a system in addition to a result: assumptions, unconnected inputs, FMUs that are out of date."""

from __future__ import annotations

import re

from ....fmus_src.paths import SYSTEMS
from ...runtime.system.prepared import PreparedSystem

MOST = 4  # names in a line
INDEX = re.compile(r"\[[\d,]+\]$")


def note_lines(prepared: PreparedSystem) -> list[str]:
    """What `perilune validate` notes of a system, a line for each kind of note.

    Of a system of this repository it is what was assumed only: an FMU of another's may fly in it.
    """
    is_ours = prepared.archive.path.is_relative_to(SYSTEMS.resolve())
    notes = prepared.assumptions if is_ours else prepared.network.notes
    kinds: dict[str, dict[str, None]] = {}
    for note in notes:
        name, _, words = note.partition(": ")
        kind = words.partition(", keeps ")[0]
        kind += ", keeps its start" if kind != words else ""
        kinds.setdefault(kind, {})[INDEX.sub("", name)] = None
    return [f"note: {_some(list(names))}: {kind}" for kind, names in kinds.items()]


def _some(names: list[str]) -> str:
    more = f" and {len(names) - MOST} more" if len(names) > MOST else ""
    return f"{', '.join(names[:MOST])}{more}"
