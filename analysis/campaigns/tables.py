"""Rows of summaries for a terminal: variants, groups, requirements and their verdicts as text."""

from __future__ import annotations

from ...common.percent import percent
from .plain_text import align_columns, ordinal, short
from .requirement_verdicts import RequirementVerdict
from .summary import Summary, SummaryRow
from .verdicts.acceptance import AcceptanceVerdict


def group_headings(group: str | None) -> list[str]:
    """Return the headings of `group_cells`; ``group`` is the draw by which trials are grouped, or None."""
    return ["variant"] if group is None else ["variant", group]


def group_cells(row: SummaryRow, group: str | None) -> list[str]:
    """Return a row's variant and, if trials are grouped, the value of its group or "all"."""
    return [row.variant] if group is None else [row.variant, row.group or "all"]


def requirement_lines(summary: Summary) -> list[str]:
    """Return a line for each requirement and variant, with figures and verdict, followed by tolerance bounds."""
    head = ["requirement", "variant", "flights", "failures", "risk %", "verdict", "more for 0, 1, 2 failures"]
    cells, bounds = [head], []
    for variant, name, result in requirement_rows(summary):
        more = ", ".join("-" if number is None else str(number) for number in result.flights_to_decide.values())
        text, risk = f"{name}: {result.text}", percent(result.consumer_risk)
        cells.append([text, variant, str(result.flights), str(result.failures), risk, str(result.verdict), more])
        if result.unevaluated:
            bounds.append(f"{variant}: {unevaluated_text(result)}")
            continue
        if result.bound is not None:
            unit = summary[variant].metrics[result.bound.metric].unit
            value = f"{short(result.bound.value)} {'' if unit == '1' else unit}".strip()
            bounds.append(f"{variant}: {bound_text(result, value)}")
    return [*align_columns(cells), *bounds] if len(cells) > 1 else []


def requirement_rows(summary: Summary) -> list[tuple[str, str, RequirementVerdict]]:
    """Return variant, name and verdict for every requirement, with all variants of a requirement together."""
    names = dict.fromkeys(name for variant in summary.values() for name in variant.requirements)
    return [(variant, name, entry.requirements[name]) for name in names for variant, entry in summary.items()]


def bound_text(result: RequirementVerdict, value: str) -> str:
    """Return the tolerance bound of a requirement, which must exist, as text; ``value`` is the text of its value."""
    bound = result.bound
    assert bound is not None
    level = f"with {100 * result.share:.10g} % probability at {100 * result.confidence:.10g} % confidence"
    if bound.rank is None:
        more = f"{bound.flights_to_decide} more trials are needed for a bound"
        return f"no {bound.side} bound of {bound.metric} {level}: {more}"
    rank = "the worst" if bound.rank == 1 else f"{ordinal(bound.rank)} worst"
    sign = "<=" if bound.side == "upper" else ">="
    return f"{bound.metric} {sign} {value} {level}: {rank} of {bound.flights}"


def unmet_lines(summary: Summary) -> list[str]:
    """Return a line for each unmet or undecided requirement of each variant, with its figures and what is missing."""
    return [
        f"{variant}: requirement {name}: {result.text}: {verdict_text(result)}"
        for variant, entry in summary.items()
        for name, result in entry.requirements.items()
        if result.verdict is not AcceptanceVerdict.MET
    ]


def verdict_text(result: RequirementVerdict) -> str:
    """Return a verdict as text: trials, failures and, if undecided, the further trials that would decide it."""
    if result.unevaluated:
        return f"{result.verdict}: {unevaluated_text(result)}"
    text = f"{result.verdict}: {result.failures} of {result.flights} trials failed"
    if result.verdict is not AcceptanceVerdict.UNDECIDED:
        return text
    more = result.flights_to_decide
    trials = f"{more[0]}, {more[1]} or {more[2]} additional trials"
    return f"{text}; {trials} with 0, 1 or 2 further failures would meet it"


def unevaluated_text(judged: RequirementVerdict) -> str:
    """Return a note on metrics of a requirement that have no value in any trial; "" if there are no such metrics."""
    if not judged.unevaluated:
        return ""
    names, verb = " and ".join(judged.unevaluated), "are" if len(judged.unevaluated) > 1 else "is"
    return f"{names} {verb} evaluated in none of {judged.flights} flights"
