"""Sections that are a table: limits at the end of a run, and a propellant budget."""

from __future__ import annotations

import math
from collections.abc import Mapping

from markupsafe import Markup

from ...runtime.flight.results import Result
from ..common.quantities import display_unit
from ..common.tables import Table
from .declared import BoundValues, Budget, Item, Limits
from .limits import Verdict, evaluate, limit_rows
from .phase_figure import spans_of
from .section import Section, align, sentence


def limit_section(limits: Limits, result: Result) -> Section:
    """The table of limits, with how many are met and which are violated, or why none is evaluated."""
    violated = [limit.name for limit, verdict in evaluate(limits, result) if verdict is Verdict.VIOLATED]
    obstacle = limits.obstacle(result)
    total = len(limits.limits)
    verdicts = Markup("{} of {} limits met").format(total - len(violated), total)
    if violated:
        verdicts = Markup("{}; violated: {}").format(verdicts, ", ".join(violated))
    return Section(
        title=limits.title,
        table=Table(
            heads=("", "final value", "limit", "unit", ""),
            rows=limit_rows(limits, result),
            numbers=(1, 2),
        ),
        findings=[sentence(Markup("not evaluated: {}").format(obstacle) if obstacle else verdicts)],
        notes=[Markup("{}").format(note) for note in limits.notes],
    )


def consumption_by_phase(budget: Budget, result: Result) -> dict[str, float]:
    """The consumption of each phase that occurred, summed over its occurrences."""
    spent: dict[str, float] = {}
    for span in spans_of(budget.of, result):
        assert span.spent is not None  # the reader of a budget demands it
        spent[span.name] = spent.get(span.name, 0.0) + span.spent
    return spent


def amount(item: Item, spent: Mapping[str, float], bound: BoundValues | None) -> float | None:
    """The amount of an item; None where one of its phases did not occur or the bound is missing."""
    values = {} if bound is None else bound.values
    if any(name not in spent for name in item.phases) or any(name not in values for name in (*item.plus, *item.minus)):
        return None
    used = (spent[name] for name in item.phases)
    return math.fsum((*used, *(values[name] for name in item.plus), *(-values[name] for name in item.minus)))


def budget_section(budget: Budget, result: Result) -> Section:
    """The table of a budget."""
    spent = consumption_by_phase(budget, result)
    unit = budget.of.spent.unit_name if budget.of.spent is not None else None
    amounts = [amount(item, spent, budget.bound) for item in budget.items]
    known = [value for value in amounts if value is not None]
    total = math.fsum(known) if len(known) == len(amounts) else None
    named = list(dict.fromkeys(name for item in budget.items for name in item.phases))
    used = math.fsum(spent[name] for name in named) if all(name in spent for name in named) else None
    names = [*(item.name for item in budget.items), "total", "consumption in these phases"]
    sources = [*map(_sum_text, budget.items), "", ", ".join(named)]
    numbers = align([*amounts, total, used], unit)
    notes = [Markup("Phase did not occur: {}.").format(name) for name in named if name not in spent]
    if budget.bound is not None and budget.bound.missing:
        notes.append(Markup("Bound not available: {}.").format(budget.bound.missing))
    return Section(
        title=budget.title,
        table=Table(
            heads=("item", display_unit(unit), "sum of"),
            rows=list(zip(names, numbers, sources, strict=True)),
            numbers=(1,),
        ),
        notes=notes,
    )


def _sum_text(item: Item) -> str:
    """The terms of an item."""
    parts = []
    if item.phases:
        parts.append(" + ".join(item.phases))
    if item.plus:
        parts.append(f"bound of {' + '.join(item.plus)}")
    terms = " + ".join(parts)
    return f"{terms} − bound of {' + '.join(item.minus)}" if item.minus else terms  # noqa: RUF001
