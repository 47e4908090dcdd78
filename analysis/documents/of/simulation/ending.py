"""Lines on the end of a simulation: limits, statuses, problems; notes on its system."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .....common.paths import SYSTEMS
from .....fmus_src.roles import FINISHED
from ....runtime.flight.results import Flight, FlightResult, status_lines
from ....runtime.system.prepared import PreparedSystem
from ...figures.declared import FigureDeclaration, LimitsFigure, UnavailableFigure
from .figures.limits import LimitVerdict, evaluate, limit_lines

REMEDIES = {
    "nonfinite": "see the signals that lead to it with `output`",
    "interrupted": "the files contain the simulation up to this time",
    "timed_out": "the files contain the simulation up to this time; give a longer limit, or see the slow step "
    "with `log`",
    "crashed": "the files contain the simulation up to this time; see the FMU's messages with `log`",
    "hung": "the files contain the simulation up to this time; see the FMU's messages with `log`",
    "out_of_memory": "the files contain the simulation up to this time; give more memory with `memory`",
}


def flight_lines(prepared: PreparedSystem, figures: Sequence[FigureDeclaration], result: FlightResult) -> list[str]:
    """Return lines on the end of a simulation: status, limits, statuses of components."""
    lines = [f"{prepared.archive.name}: {result.ending}"]
    for figure in figures:
        if isinstance(figure, LimitsFigure):
            lines += limit_lines(figure, result)
        elif isinstance(figure, UnavailableFigure) and figure.has_limits:
            lines += [f"{figure.title}: {LimitVerdict.NOT_EVALUATED}, {note}" for note in figure.notes]
    return [*lines, *status_lines(prepared.network, result)]


def flight_problems(prepared: PreparedSystem, figures: Sequence[FigureDeclaration], result: FlightResult) -> list[str]:
    """Return a line for each reason why a simulation did not complete or violates a limit of its SSD."""
    file, lines = prepared.network.file, []
    if not result.complete:
        remedy = REMEDIES.get(result.status, "see the FMU's message and its documentation")
        lines.append(f"{' '.join(result.message.split())}; {remedy}")
    elif _is_cut_off(prepared, result):
        lines.append(f"{FINISHED} was not true before the stop time, {result.time[-1]:g} s; give a later `stop_time`")
    for figure in figures if result.complete else ():
        if isinstance(figure, LimitsFigure):
            named = {
                verdict: [limit.name for limit, each in evaluate(figure, result) if each is verdict]
                for verdict in LimitVerdict
            }
            if named[LimitVerdict.VIOLATED]:
                lines.append(f"limits violated: {', '.join(named[LimitVerdict.VIOLATED])}")
            if named[LimitVerdict.NOT_EVALUATED]:
                names = ", ".join(named[LimitVerdict.NOT_EVALUATED])
                lines.append(f"limits not evaluated: {names}: {figure.obstacle(result)}")
        elif isinstance(figure, UnavailableFigure) and figure.has_limits:
            lines += [f"limits not evaluated: {note}" for note in figure.notes]
    return [f"{file}: {line}" for line in lines]


def _is_cut_off(prepared: PreparedSystem, result: Flight) -> bool:
    """Return True if a system with an output ``finished`` did not finish before a default stop time."""
    end = prepared.network.nodes.get(FINISHED)
    says_so = end is not None and end.component is None and end.kind == "output"
    return says_so and result.status == "stop_time" and prepared.options.chosen["stop_time"] is None


MOST = 4  # names in a line
INDEX = re.compile(r"\[[\d,]+\]$")


def note_lines(prepared: PreparedSystem) -> list[str]:
    """Return the notes of `perilune validate` on a system, a line for each kind of note.

    For a system of this repository, which may contain a foreign FMU, only assumptions are listed.
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
