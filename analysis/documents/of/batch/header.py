"""Header of a batch's page: verdicts, lost trials, success criterion, and the command that repeats the batch."""

from __future__ import annotations

from ....campaigns.lost_trials import describe_lost_trials
from ....commands.campaigns import batch_command
from ...cell import Code, Quantity
from ...model import KeyNumbers, Node, Repeat, Text
from ..campaign.replays import anchors_of
from ..campaign.verdicts import unjudged_node, verdict_nodes
from ..origin import condition_notes
from .content import BatchContent


def header_nodes(content: BatchContent) -> list[Node]:
    """Return nodes with the verdicts on variants, and the conditions of the batch."""
    campaign, provenance = content.campaign, content.batch.provenance
    command = batch_command(content.batch.plan)
    return [
        *([Text(campaign.description.removesuffix("."), style="lead")] if campaign.description else []),
        *([] if content.verdicts.has_verdicts else [unjudged_node()]),
        *verdict_nodes(content.verdicts, content.styles, anchors_of(content.replays)),
        *(Text(["", line], style="fail") for line in describe_lost_trials(content.batch.summary)),
        Text([
            "success criterion: ", Code(campaign.success.text),
            ". All variants use the same samples of the dispersed parameters",
        ]),
        *([Repeat(command)] if command else []),
        KeyNumbers([
            ("system", provenance["system"]),
            ("variants", str(len(content.batch.summary))),
            ("trials per variant", provenance["trials"]),
            ("seed", provenance["seed"]),
            ("communication step", Quantity(provenance["step"], "s")),
            ("algorithm", provenance["algorithm"]),
            ("perilune", provenance["perilune"]),
        ]),
        *condition_notes(provenance),
    ]  # fmt: skip
