"""The section of a page that holds the end of a run against its limits."""

from __future__ import annotations

from markupsafe import Markup

from ...flight.results import Result
from .asked.stages import Limits
from .limit_table import is_kept, limit_rows
from .section import Section, Table, sentence


def limit_section(limits: Limits, result: Result) -> Section:
    """The table of limits, and how many of them are kept."""
    broken = [limit.name for limit in limits.limits if not is_kept(limit, result)]
    count = len(limits.limits)
    words = Markup("not kept: {}").format(", ".join(broken)) if broken else Markup("all {} kept").format(count)
    return Section(
        title=limits.title,
        table=Table(
            heads=("", "at the end", "limit", "unit", ""),
            rows=limit_rows(limits, result),
            numbers=(1, 2),
        ),
        findings=[sentence(words)],
        notes=[Markup("{}").format(note) for note in limits.notes],
    )
