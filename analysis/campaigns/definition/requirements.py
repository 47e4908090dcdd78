"""Requirements of a campaign: the share of all simulations that must satisfy a condition, and the confidence."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from ....common.errors import suggestion
from ..draws.interfaces import Design, Draw
from .expressions import Expression
from .table import REQUIRED, TomlTable, choice_of, expression, number, text

KEYS = ("expression", "share", "confidence", "metric", "bound", "description")
SIDES = ("upper", "lower")
SUCCESS = "success"  # name, in expressions of requirements, of a trial's success


@dataclass(frozen=True)
class Requirement:
    """Requirement [requirement.NAME]: a ``share`` of all simulations satisfies ``expression``, with ``confidence``.

    ``expression`` is over the metrics of a trial, and `SUCCESS`. ``metric`` is a metric with a tolerance bound: the
    share of all simulations satisfies this bound, which is on the side ``bound`` ("upper" or "lower"), with the
    confidence. It is None if the requirement has no such metric.
    """

    name: str
    expression: Expression
    share: float
    confidence: float
    metric: str | None = None
    bound: str = "upper"
    description: str = ""

    def __str__(self) -> str:
        probability, confidence = f"{100 * self.share:.10g} %", f"{100 * self.confidence:.10g} %"
        return f"{self.expression.text}, {probability} probability at {confidence} confidence"


def read_requirements(table: TomlTable, metrics: Collection[str], draws: Iterable[Draw]) -> tuple[Requirement, ...]:
    """Return the requirements in the table [requirement]; ``metrics`` are the campaign's metrics by name.

    Verdicts need independent trials, so draws that are designed for all trials together are rejected. Raises
    InputError.
    """
    for draw in draws:
        if table.content and isinstance(draw.distribution, Design):
            problem = (
                f"{draw.name} has the distribution {draw.distribution.keyword}, but verdicts need independent trials"
            )
            remedy = f"use {draw.distribution.alternative}, or remove the requirements"
            raise table.error("", problem, remedy)
    return tuple(_requirement(name, each, metrics) for name, each in table.subtables())


def _requirement(name: str, table: TomlTable, metrics: Collection[str]) -> Requirement:
    table.only(KEYS)
    requested = table.get("expression", expression)
    known = [*metrics, SUCCESS]
    for unknown in sorted(requested.names - set(known)):
        raise table.error("expression", f"{unknown!r} is not a metric", suggestion(unknown, known))
    if not requested.names:
        raise table.error("expression", "uses no metric and cannot be evaluated", suggestion("", known))
    metric = table.get("metric", text, REQUIRED if "bound" in table.content else None)
    if metric is not None and metric not in metrics:
        raise table.error("metric", f"{metric!r} is not a metric", suggestion(metric, metrics))
    return Requirement(
        name=name,
        expression=requested,
        share=table.get("share", _share),
        confidence=table.get("confidence", _confidence),
        metric=metric,
        bound=table.get("bound", choice_of(*SIDES), "upper" if metric is None else REQUIRED),
        description=table.get("description", text, ""),
    )


def _share(table: TomlTable, key: str, value: object) -> float:
    """Return a number between 0 and 1, also from a text in per cent such as "99.87 %"."""
    written = value.strip() if isinstance(value, str) else ""
    percent = written.endswith("%")
    fraction = number(table, key, written[:-1] if percent else value) / (100.0 if percent else 1.0)
    if not 0.0 < fraction < 1.0:
        problem = f"{value!r} is not between 0 and 1"
        raise table.error(key, problem, 'write a fraction, or a percentage in quotes: 0.9987 or "99.87 %"')
    return fraction


def _confidence(table: TomlTable, key: str, value: object) -> float:
    confidence = _share(table, key, value)
    if confidence < 0.5:
        raise table.error(
            key, f"{value!r} is below 0.5, where a requirement could be both met and not met", 'write 0.9, or "90 %"'
        )
    return confidence
