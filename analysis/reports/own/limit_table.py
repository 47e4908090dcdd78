"""What was at the end of the run against its limits."""

from __future__ import annotations

from markupsafe import Markup

from ...flight.results import Result
from ..kit.page import exact
from ..kit.quantities import shown_unit
from .asked.stages import Limit, Limits

VERDICTS = {
    True: Markup('<span class="verdict pass">kept</span>'),
    False: Markup('<span class="verdict fail">not kept</span>'),
}


def is_kept(limit: Limit, result: Result) -> bool:
    """Whether the last row keeps a limit, the limit itself included; what is not finite does not."""
    value = limit.value(result)
    above = limit.least is None or value >= limit.least
    below = limit.most is None or value <= limit.most
    return above and below and abs(value) < float("inf")


def limit_lines(limits: Limits, result: Result) -> list[str]:
    """For a terminal: a line for each limit, angles in deg."""
    return [
        " ".join(Markup("{}: {} {}, {}: {}").format(name, value, unit, most, verdict).striptags().split())
        for name, value, most, unit, verdict in limit_rows(limits, result)
    ]


def limit_rows(limits: Limits, result: Result) -> list[tuple[Markup | str, ...]]:
    """A row for each limit: its name, the value at the end, the limit, their unit, the verdict."""
    return [_row(limit, result) for limit in limits.limits]


def _row(limit: Limit, result: Result) -> tuple[Markup | str, ...]:
    unit = limit.signal.unit_name
    return (
        limit.name,
        exact(limit.value(result), unit),
        _limit(limit, unit),
        shown_unit(unit),
        VERDICTS[is_kept(limit, result)],
    )


def _limit(limit: Limit, unit: str | None) -> Markup:
    if limit.least is None or limit.most is None:
        word, value = ("at most", limit.most) if limit.least is None else ("at least", limit.least)
        return Markup("{} {}").format(word, exact(value, unit))
    return Markup("{} to {}").format(exact(limit.least, unit), exact(limit.most, unit))
