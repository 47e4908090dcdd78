"""Requirements of a campaign: verdicts, risks, and the additional trials that would decide them."""

from __future__ import annotations

from collections.abc import Mapping

from ....campaigns.definition.campaign import Campaign
from ....campaigns.requirement_verdicts import RequirementVerdict
from ....campaigns.summary import Summary
from ....campaigns.tables import bound_text, requirement_rows, unevaluated_text
from ...cell import Cell, Code, Head, Percentage, Phrase, Quantity, Row, RowHeading, RowNote, Strong, VerdictCell
from ...common.quantities import display_unit, in_display_unit, number
from ...model import Node, Note, Section, Table
from ..campaign.verdict_table import GRADES


def requirement_sections(summary: Summary, campaign: Campaign) -> list[Section]:
    """Return the section of verdicts on each requirement by variant; no section without requirements."""
    verdicts = requirement_rows(summary)
    if not verdicts:
        return []
    described = {requirement.name: requirement.description for requirement in campaign.requirements}
    units = {metric.name: metric.unit for metric in campaign.metrics}
    body: list[tuple[Cell, ...] | Row | RowHeading | RowNote] = []
    above = None
    for variant, name, result in verdicts:
        if name != above:
            body.append(RowHeading([Strong(name), " ", Code(result.text)], described[name]))
        above = name
        body.append(_row(variant, result))
        bound = _bound(result, units)
        if bound:
            body.append(RowNote(bound))
    heads = (
        "variant", "verdict", "trials", "failures", "consumer's risk, %",
        Head("additional trials required", column="numbers"),
    )  # fmt: skip
    is_early = verdicts[0][2].rule == "until decided"
    nodes: list[Node] = [Table(heads, body, style=""), Note(EXPLANATION + (EARLY if is_early else ""))]
    return [Section("Requirements", nodes)]


EXPLANATION = (
    "Consumer's risk: probability of at most k failures, where k is the observed number, if the true probability "
    "equals the required probability. The requirement is met if this risk is at most 1 minus the confidence "
    "level, and not met if, under the same assumption, k or more failures are as improbable. Additional "
    "trials required: numbers of trials for 0, 1 and 2 further failures."
)
EARLY = " The campaign was allowed to end early; risks and verdicts account for all interim analyses."


def _row(variant: str, result: RequirementVerdict) -> tuple[Cell, ...]:
    more: Cell = ""
    if result.decided_after is None:
        numbers = [Quantity(each) for each in result.flights_to_decide.values()]
        more = Phrase([each for number in numbers for each in (", ", number)][1:])
    return (
        variant,
        VerdictCell(result.verdict, GRADES[result.verdict]),
        result.flights,
        result.failures,
        Percentage(result.consumer_risk),
        more,
    )


def _bound(result: RequirementVerdict, units: Mapping[str, str]) -> str:
    """Return the tolerance bound of a requirement, or the metrics that have no value in any trial."""
    if result.unevaluated or result.bound is None:
        return unevaluated_text(result)
    unit = units[result.bound.metric]
    return bound_text(result, f"{number(in_display_unit(result.bound.value, unit))} {display_unit(unit)}".strip())
