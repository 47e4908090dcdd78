"""Document of a batch: verdicts on its variants, distributions, recorded simulations, failures, tables."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ....campaigns.execute.campaign_result import CampaignResult
from ...cell import Code
from ...model import Document, Group, Medium, Missing, Node, Note, Only, Printed, Section
from ..campaign.campaign_origin import fmu_rows, parameter_table
from ..campaign.metrics import group_nodes, metric_nodes
from ..campaign.replays import replay_table
from ..campaign.statuses import component_statuses, component_table, status_table
from ..campaign.variants import group_rows, variant_rows
from ..origin import digest_table
from .content import BatchContent
from .correlations import driver_sections, failure_section
from .distribution_sections import distribution_section, other_distribution_sections
from .header import header_nodes
from .notebook_nodes import notebook_nodes
from .printed import printed_lines
from .recorded_section import recorded_sections
from .replays import extremes_to_replay
from .requirements import requirement_sections
from .scatters import scatter_nodes, scatter_title


def batch_document(batch: CampaignResult, printed: Sequence[str] = ()) -> Document:
    """Return the document of a batch; a terminal lists the metrics ``printed``."""
    content = BatchContent(batch)
    return Document(
        batch.provenance["system"],
        [
            Only(Medium.TERMINAL, lambda: [Printed(printed_lines(batch, printed))]),
            Only(Medium.NOTEBOOK, partial(notebook_nodes, content)),
            Only(Medium.PAGE, partial(header_nodes, content)),
        ],
        [],
        batch.content,
        has_contents=True,
        in_degrees="Angles of metrics",
        page_sections=partial(_sections, content),
    )


def _sections(content: BatchContent) -> list[Section]:
    batch, campaign = content.batch, content.campaign
    return [
        *requirement_sections(batch.summary, campaign),
        distribution_section(content),
        *(Section(scatter_title(each), scatter_nodes(batch, each)) for each in campaign.scatters),
        *recorded_sections(batch),
        failure_section(content),
        *_group_sections(content),
        *other_distribution_sections(content),
        Section(
            "Metrics of successful trials", metric_nodes(variant_rows(batch.summary), content.metrics), is_folded=True
        ),
        *driver_sections(content),
        _status_section(batch),
        *_replay_sections(content),
        _parameter_section(content),
        _provenance_section(batch),
    ]


def _group_sections(content: BatchContent) -> list[Section]:
    by = content.campaign.group
    if by is None:
        return []
    return [Section(f"By {by}", group_nodes(group_rows(content.batch.summary), content.metrics, by))]


def _status_section(batch: CampaignResult) -> Section:
    nodes: list[Node] = [
        status_table(batch.summary),
        Note("In parentheses: highest status reported by a component during the flight."),
    ]
    rows = component_statuses(batch.summary)
    if rows:
        note = Note("Highest status of each component in a trial, counted separately for each component.")
        nodes.append(Group("Statuses by component", [component_table(rows), note]))
    return Section("Termination status", nodes, is_folded=True)


def _replay_sections(content: BatchContent) -> list[Section]:
    replays, extremes = content.replays, extremes_to_replay(content.batch)
    if not (replays or extremes):
        return []
    nodes: list[Node] = [Note(["With ", Code("--output DIR"), " all signals of the trial are stored."])]
    if content.batch.folder is not None:
        nodes = [
            Note([
                "Bit-identical replay from the campaign folder. ", Code("--output F.csv"), " stores all signals, ",
                Code("--report F.html"), " writes the page of the run.",
            ])
        ]  # fmt: skip
    if replays:
        nodes += [
            replay_table(replays, "termination, worst of metrics"),
            Note("The first failures of each variant, and its worst trials for each metric with a limit."),
        ]
    if extremes:
        nodes.append(Group("Maximum of each metric", [replay_table(extremes, "maximum")]))
    return [Section("Replay commands", nodes, is_folded=True)]


def _parameter_section(content: BatchContent) -> Section:
    table = parameter_table(content.campaign)
    nodes: list[Node] = [table, Note("As the campaign declares them, in SI units.")]
    if not table.rows:
        reason = "none: all trials have the same parameters and differ in the random streams of components only"
        nodes = [Missing(reason)]
    return Section("Dispersed parameters", nodes, is_folded=True)


def _provenance_section(batch: CampaignResult) -> Section:
    provenance = batch.provenance
    rows = [("system", "all", provenance["system_sha256"]), *fmu_rows(provenance["fmus"])]
    nodes: list[Node] = [Note(["Campaign ", Code(provenance["campaign"])]), digest_table(("part", "variants"), rows)]
    return Section("Provenance", nodes, is_folded=True)
