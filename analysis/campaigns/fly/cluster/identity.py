"""Whether a worker has the same perilune: flights are the same to the bit with the same sources only."""

from __future__ import annotations

import hashlib
from functools import cache
from importlib.metadata import version
from typing import Any

from .....fmus_src.paths import PACKAGE
from ....common.errors import InputError

ROOMS = ("analysis", "fmus_src")
Identity = tuple[str, str]


@cache
def identity() -> Identity:
    """The version of this perilune, and the SHA-256 of its sources."""
    total = hashlib.sha256()
    for room in ROOMS:
        place = (PACKAGE / room).resolve()  # a link in a checkout
        for path in sorted(place.rglob("*.py")):
            total.update(path.relative_to(place).as_posix().encode() + b"\0" + path.read_bytes())
    return version("perilune"), total.hexdigest()


def refuse_others(ours: Identity, theirs: Any, worker: str) -> None:
    """Raise InputError unless a worker has the same perilune; ``theirs`` is an exception where it has none."""
    if isinstance(theirs, BaseException):
        problem = f"worker {worker} cannot load perilune: {' '.join(str(theirs).split())}"
    elif theirs[0] != ours[0]:
        problem = f"worker {worker} has perilune {theirs[0]}, the campaign is flown from {ours[0]}"
    elif theirs != ours:
        problem = f"worker {worker} has other sources of perilune {ours[0]}"
    else:
        return
    raise InputError("`scheduler`", "", problem, "install the same in its environment, then start it again")
