"""Metadata of a stored campaign, in summary.json: inputs that determine its numbers; units and types of columns."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import NotRequired, TypedDict


class SignalMetadata(TypedDict, total=False):
    """Unit of a signal (None if undeclared), its FMI type, and the name of its axis if it has one."""

    unit: str | None
    type: str
    axis: str


class MetricMetadata(TypedDict):
    """Metric as declared by its campaign, with True if it is a truth value, and with the name of its axis, if any."""

    axis: NotRequired[str]
    condition: NotRequired[str]
    delay: NotRequired[float]
    expression: str
    reduction: str
    unit: str
    description: str
    truth: bool


class RecordMetadata(TypedDict):
    """Recording of trials over time: signals in every ``every``-th row of the first ``trials`` trials, and traces."""

    every: int | None
    signals: list[str]
    trials: int | None
    traces: str


class CampaignMetadata(TypedDict, total=False):
    """Properties of a batch that do not follow from its numbers.

    ``group``, ``faults``, ``sweep``, ``draws_sha256`` (of supplied draws) and ``draw_scheme`` (other than a table) are
    only present if there is one. ``success`` is an expression. ``signals`` are the recorded signals. ``targets``
    contains the parameters target_position and target_velocity by variant.
    """

    group: str
    faults: list[str]
    sweep: dict[str, str]
    draws_sha256: str
    draw_scheme: str
    description: str
    success: str
    metrics: dict[str, MetricMetadata]
    record: RecordMetadata
    signals: dict[str, SignalMetadata]
    targets: dict[str, dict[str, float]]


class CampaignProvenance(CampaignMetadata, total=False):
    """Inputs that determine a batch's numbers, other than the trials themselves.

    ``batch`` is the key of the batch. Folders written by earlier versions contain, in ``manifest``, a key derived from
    their manifest instead.
    """

    system: str
    system_sha256: str
    campaign: str
    campaign_sha256: str
    parameter_sets: list[str]
    set: Mapping[str, object]
    variant: str | None
    start_time: float
    steps: int
    trials: int
    seed: int
    step: float
    algorithm: str
    feedthrough: list[str]
    no_feedthrough: list[str]
    assumptions: list[str]
    input: object
    timeout: float
    fmus: dict[str, dict[str, str]]
    perilune: str
    batch: str
    manifest: str


def batch_digest(provenance: Mapping[str, object]) -> str:
    """Return the SHA-256 that identifies a batch independently of its number of trials, since it can be extended.

    For folders of earlier versions it is the SHA-256 of the provenance as JSON with sorted keys.
    """
    if "batch" in provenance:
        return str(provenance["batch"])
    return hashlib.sha256(json.dumps({**provenance, "trials": None}, sort_keys=True).encode()).hexdigest()
