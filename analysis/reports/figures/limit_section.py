"""The section of a page that holds the end of a run against its limits."""

from __future__ import annotations

from markupsafe import Markup

from ...runtime.flight.results import Result
from .declaration.stages import Limits
from .limit_table import Verdict, evaluate, limit_rows
from ..common.tables import Table
from .section import Section, sentence


def limit_section(limits: Limits, result: Result) -> Section:
    """The table of limits, and which are not kept, or why none is evaluated."""
    broken = [limit.name for limit, verdict in evaluate(limits, result) if verdict is Verdict.NOT_KEPT]
    obstacle = limits.obstacle(result)
    words = (
        Markup("not kept: {}").format(", ".join(broken)) if broken else Markup("all {} kept").format(len(limits.limits))
    )
    return Section(
        title=limits.title,
        table=Table(
            heads=("", "at the end", "limit", "unit", ""),
            rows=limit_rows(limits, result),
            numbers=(1, 2),
        ),
        findings=[sentence(Markup("not evaluated: {}").format(obstacle) if obstacle else words)],
        notes=[Markup("{}").format(note) for note in limits.notes],
    )
