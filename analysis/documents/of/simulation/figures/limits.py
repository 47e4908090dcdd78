"""Limits on final values of a run: verdicts, and their tables, lines and JSON."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from math import isfinite
from typing import Any

from .....runtime.flight.results import Flight
from ....cell import Cell, Grade, Phrase, Quantity, VerdictCell
from ....common.quantities import NONE, display_unit
from ....figures.declared import FigureDeclaration, Limit, LimitsFigure, UnavailableFigure
from ....render.words import cell_text
from ...reserve import TIGHTEST, relative_reserve
from .figure_texts import value_range


class LimitVerdict(StrEnum):
    """Verdict on a limit."""

    MET = "met"
    VIOLATED = "violated"
    NOT_EVALUATED = "not evaluated"


LABELS = {LimitVerdict.MET: "PASS", LimitVerdict.VIOLATED: "FAIL", LimitVerdict.NOT_EVALUATED: "not evaluated"}
GRADES: dict[LimitVerdict, Grade] = {
    LimitVerdict.MET: "pass",
    LimitVerdict.VIOLATED: "fail",
    LimitVerdict.NOT_EVALUATED: "not-applicable",
}


def evaluate(limits: LimitsFigure, result: Flight) -> list[tuple[Limit, LimitVerdict]]:
    """Return the limits in order, each with its verdict."""
    if limits.obstacle(result):
        return [(limit, LimitVerdict.NOT_EVALUATED) for limit in limits.limits]
    return [(limit, LimitVerdict.MET if is_met(limit, result) else LimitVerdict.VIOLATED) for limit in limits.limits]


def is_met(limit: Limit, result: Flight) -> bool:
    """Return True if the final value is finite and within the limits, ends included."""
    value = limit.value(result)
    above = limit.least is None or value >= limit.least
    below = limit.most is None or value <= limit.most
    return above and below and abs(value) < float("inf")


def limit_lines(limits: LimitsFigure, result: Flight) -> list[str]:
    """Return a line for each limit for a terminal, angles in deg."""
    obstacle = limits.obstacle(result)
    form = "{0} ({2} {3}): {4}, {5}" if obstacle else "{0} {1} {3} ({2} {3}): {4}"
    lines = (form.format(*map(cell_text, row), obstacle) for row in limit_rows(limits, result))
    return [" ".join(line.replace(" )", ")").split()) for line in lines]


def limit_rows(limits: LimitsFigure, result: Flight) -> list[tuple[Cell, ...]]:
    """Return a row for each limit: name, final value, limit, unit, verdict."""
    evaluated = evaluate(limits, result)
    nearest = None
    if len(evaluated) > 1 and not limits.obstacle(result):
        nearest = min(limits.limits, key=lambda limit: relative_reserve(limit.value(result), limit.least, limit.most))
    return [_row(limit, verdict, result, is_tightest=limit is nearest) for limit, verdict in evaluated]


def limit_document(figures: Sequence[FigureDeclaration], result: Flight) -> list[dict[str, Any]]:
    """Return all limits of a system as JSON, an object each."""
    document: list[dict[str, Any]] = []
    for figure in figures:
        if isinstance(figure, LimitsFigure):
            document += limit_entries(figure, result)
        elif isinstance(figure, UnavailableFigure) and figure.has_limits:
            document += [
                {"name": figure.title, "verdict": LimitVerdict.NOT_EVALUATED, "reason": note} for note in figure.notes
            ]
    return document


def limit_entries(limits: LimitsFigure, result: Flight) -> list[dict[str, Any]]:
    """Return limits as JSON: values in ``unit`` (None: no limit), and the reason if one is not evaluated."""
    obstacle = limits.obstacle(result)
    return [
        {
            "name": limit.name,
            "value": None if obstacle or not isfinite(limit.value(result)) else limit.value(result),
            "unit": limit.signal.unit_name,
            "least": limit.least,
            "most": limit.most,
            "verdict": verdict,
            **({"reason": obstacle} if obstacle else {}),
        }
        for limit, verdict in evaluate(limits, result)
    ]


def _row(limit: Limit, verdict: LimitVerdict, result: Flight, *, is_tightest: bool) -> tuple[Cell, ...]:
    unit = limit.signal.unit_name
    judged = VerdictCell(LABELS[verdict], GRADES[verdict])
    return (
        limit.name,
        NONE if verdict is LimitVerdict.NOT_EVALUATED else Quantity(limit.value(result), unit, is_bare=True),
        value_range(limit.least, limit.most, unit),
        display_unit(unit),
        Phrase([judged, f", {TIGHTEST}"], is_unbroken=False) if is_tightest else judged,
    )
