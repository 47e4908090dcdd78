"""What was at the end of the run against its limits."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from math import isfinite
from typing import Any

from markupsafe import Markup

from ...runtime.flight.results import Flight
from ..common.page import exact
from ..common.quantities import shown_unit
from .declaration.declared import Figure
from .declaration.stages import Limit, Limits
from .declaration.values import Undrawn


class Verdict(StrEnum):
    """How a run stands to a limit."""

    KEPT = "kept"
    NOT_KEPT = "not kept"
    NOT_EVALUATED = "not evaluated"


LOOKS = {Verdict.KEPT: "pass", Verdict.NOT_KEPT: "fail", Verdict.NOT_EVALUATED: "not-applicable"}
NONE = "\N{EN DASH}"  # in a number's place


def evaluate(limits: Limits, result: Flight) -> list[tuple[Limit, Verdict]]:
    """The limits in their order, each with its verdict."""
    if limits.obstacle(result):
        return [(limit, Verdict.NOT_EVALUATED) for limit in limits.limits]
    return [(limit, Verdict.KEPT if is_kept(limit, result) else Verdict.NOT_KEPT) for limit in limits.limits]


def is_kept(limit: Limit, result: Flight) -> bool:
    """Whether the last row keeps a limit, the limit itself included; what is not finite does not."""
    value = limit.value(result)
    above = limit.least is None or value >= limit.least
    below = limit.most is None or value <= limit.most
    return above and below and abs(value) < float("inf")


def limit_lines(limits: Limits, result: Flight) -> list[str]:
    """For a terminal: a line for each limit, angles in deg."""
    obstacle = limits.obstacle(result)
    form = Markup("{0}: {2} {3}: {4}, {5}" if obstacle else "{0}: {1} {3}, {2}: {4}")
    return [" ".join(form.format(*row, obstacle).striptags().split()) for row in limit_rows(limits, result)]


def limit_rows(limits: Limits, result: Flight) -> list[tuple[Markup | str, ...]]:
    """A row for each limit: its name, the value at the end, the limit, their unit, the verdict."""
    return [_row(limit, verdict, result) for limit, verdict in evaluate(limits, result)]


def limit_document(figures: Sequence[Figure], result: Flight) -> list[dict[str, Any]]:
    """All limits that a system asks for, for other programs, a dictionary each."""
    found: list[dict[str, Any]] = []
    for figure in figures:
        if isinstance(figure, Limits):
            found += limit_facts(figure, result)
        elif isinstance(figure, Undrawn) and figure.has_limits:
            found += [{"name": figure.title, "verdict": Verdict.NOT_EVALUATED, "reason": note} for note in figure.notes]
    return found


def limit_facts(limits: Limits, result: Flight) -> list[dict[str, Any]]:
    """The same for other programs: values in ``unit``, None where there is none, and why one is not evaluated."""
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


def _row(limit: Limit, verdict: Verdict, result: Flight) -> tuple[Markup | str, ...]:
    unit = limit.signal.unit_name
    return (
        limit.name,
        NONE if verdict is Verdict.NOT_EVALUATED else exact(limit.value(result), unit),
        _limit(limit, unit),
        shown_unit(unit),
        Markup('<span class="verdict {}">{}</span>').format(LOOKS[verdict], verdict),
    )


def _limit(limit: Limit, unit: str | None) -> Markup:
    if limit.least is None or limit.most is None:
        word, value = ("at most", limit.most) if limit.least is None else ("at least", limit.least)
        return Markup("{} {}").format(word, exact(value, unit))
    return Markup("{} to {}").format(exact(limit.least, unit), exact(limit.most, unit))
