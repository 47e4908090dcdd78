"""What flies trials side by side: threads of this process, or processes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ....common.errors import InputError, suggestion

if TYPE_CHECKING:
    from ....runtime.system.prepared import PreparedSystem

ENGINES = ("threads", "processes")


def in_threads(systems: Iterable[PreparedSystem], engine: str | None) -> bool:
    """Whether trials fly in threads: as asked, or wherever they can. Raises InputError where they cannot."""
    can = all(prepared.flies_in_threads for prepared in systems)
    if engine is None:
        return can
    if engine not in ENGINES:
        raise InputError("`engine`", engine, "unknown", suggestion(engine, ENGINES))
    if engine == "threads" and not can:
        problem = "Python FMUs, and those of which a process can hold one instance, do not fly in threads"
        raise InputError("`engine`", engine, problem, "use processes, or native FMUs")
    return engine == "threads"
