"""Section on recorded simulations of a batch: a scene of all, and signals of a pinned trial."""

from __future__ import annotations

from ....campaigns.execute.campaign_result import CampaignResult
from ...model import ForScript, Node, Note, Section
from ...pictures import Scene
from .embedded_flights import embedded_flights


def recorded_sections(batch: CampaignResult) -> list[Section]:
    """Return the section on recorded simulations, which only scripts can display; no section without simulations."""
    embedded = embedded_flights(batch)
    if embedded is None:
        return []
    pinned = Note("A pinned trial shows its signals over time next to its numbers.")
    nodes: list[Node] = [
        *([Scene(embedded.scene.scene, notes=embedded.scene.notes)] if embedded.scene is not None else []),
        Note(" ".join(embedded.notes)),
        ForScript("", "curves", None, [pinned], "answers"),
    ]
    recorded = ForScript("recorded", "curves", embedded.document, nodes, anchor="flights")
    return [Section("Recorded flights", [recorded], style="screen")]
