"""Document of a comparison: verdicts and differences of variants on the same trials, figures, tables."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from .....common.percent import short_percent
from ....campaigns.compare.campaign_comparison import CampaignComparison, name_of, rate_text
from ....campaigns.summary import summary_rows
from ....campaigns.tables import group_cells, group_headings
from ...cell import Cell, Code
from ...model import Document, Medium, Node, Note, Only, Printed, Section, Table, Text
from ...pictures import Figure
from ..campaign.metrics import metric_summary
from ..campaign.replays import replay_table
from ..campaign.statuses import status_table
from ..campaign.verdicts import unjudged_node
from .content import ComparisonContent
from .flights.sections import end_section, ends_by_variant_section, error_section, time_sections, trajectory_section
from .header import header_nodes
from .metric_sections import (
    distribution_section,
    group_section,
    metric_section,
    other_distribution_section,
    pair_section,
    rate_section,
)
from .provenance import parameter_section, provenance_section
from .variant_distributions import metric_figures, overlaid_figures


def comparison_document(comparison: CampaignComparison, command: str, printed: Sequence[str] = ()) -> Document:
    """Return the document of a comparison; ``command`` repeats it, and a terminal lists the metrics ``printed``."""
    content = ComparisonContent(comparison)
    system = comparison.first.document["system"]
    return Document(
        f"{system}: {len(comparison.contenders)} variants on the same trials",
        [
            Only(Medium.TERMINAL, lambda: [Printed(comparison.text(printed).splitlines())]),
            Only(Medium.NOTEBOOK, partial(notebook_nodes, content)),
            Only(Medium.PAGE, lambda: header_nodes(content, command)),
        ],
        [],
        comparison.content,
        has_contents=True,
        page_sections=partial(_sections, content),
    )


def _sections(content: ComparisonContent) -> list[Section]:
    return [
        *trajectory_section(content),
        distribution_section(content),
        *end_section(content),
        *time_sections(content),
        *ends_by_variant_section(content),
        *error_section(content),
        *other_distribution_section(content),
        rate_section(content),
        metric_section(content),
        *group_section(content),
        pair_section(content),
        _status_section(content.comparison),
        *_replay_section(content),
        parameter_section(content.comparison),
        provenance_section(content.comparison),
    ]


def _status_section(comparison: CampaignComparison) -> Section:
    note = Note("In brackets: the worst status that a component reported during the flight.")
    return Section("Termination status", [status_table(comparison.summary), note], is_folded=True)


def _replay_section(content: ComparisonContent) -> list[Section]:
    if not content.replays:
        return []
    note = Note([
        "The first failures of each variant, and its worst trials for each metric with a limit; replays need only the "
        "campaign's folder and are bit-identical. ", Code("--output F.csv"), " keeps all signals, ",
        Code("--report F.html"), " writes the page of the run.",
    ])  # fmt: skip
    nodes: list[Node] = [replay_table(content.replays, "ended, worst of metrics"), note]
    return [Section("Replay commands", nodes, is_folded=True)]


def notebook_nodes(content: ComparisonContent) -> list[Node]:
    """Return notes, tables of rates and metrics, and distributions of metrics that vary."""
    compared = content.comparison

    def draw() -> list[Figure]:
        return metric_figures(content.distributions, content.sorted_metrics[0], content.styles)

    rows = summary_rows(compared.summary)
    names = [name_of(rate) for rate in compared.rates]
    rates: list[Sequence[Cell]] = [
        (
            *group_cells(row, compared.group),
            row.entry.trials,
            *(rate_text(row.entry.rates[name], short_percent) for name in names),
        )
        for row in rows
    ]
    heads = (*group_headings(compared.group), "trials", *(f"{name}, %" for name in names))
    return [
        *map(Text, compared.notes),
        *([] if compared.has_requirements else [unjudged_node()]),
        Table(heads, rates),
        metric_summary(rows, compared.metrics, compared.group),
        overlaid_figures(draw, content.styles),
    ]
