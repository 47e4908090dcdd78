"""File summary.json, which completes a campaign's folder: provenance, and the summary by variant."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from ....common.bounds import INPUT_BYTES
from ....common.errors import InputError
from ....common.regular import read_regular
from ..definition.campaign import Metric
from ..definition.expressions import Expression
from ..trial_columns import describe_metric
from .campaign_manifest import WRITE
from .provenance import CampaignProvenance
from .shard_files import NEW_FOLDER


class SummaryDocument(CampaignProvenance, total=False):
    """Content of summary.json: the provenance, and the summary by variant."""

    variants: Mapping[str, object]


FACTS = (
    "system", "system_sha256", "campaign", "campaign_sha256", "parameter_sets", "set", "variant", "trials", "seed",
    "step", "algorithm", "fmus", "perilune", "description", "success", "metrics", "record", "signals", "targets",
)  # fmt: skip


def without_summary(document: SummaryDocument) -> CampaignProvenance:
    """Return the content of summary.json except the summary: the inputs that determine the batch's numbers."""
    entries = document.copy()
    del entries["variants"]
    return entries


def read_summary(path: Path) -> SummaryDocument:
    """Return the content of summary.json. Raises InputError for any other file, and for a file of an older version."""
    content = read_regular(path, NEW_FOLDER, INPUT_BYTES.limit)
    try:
        document = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise InputError(path, "", f"not JSON: {error}", NEW_FOLDER) from error
    variants = document.get("variants") if isinstance(document, dict) else None
    if not isinstance(variants, dict) or not variants:
        raise InputError(path, "variants", "missing", WRITE)
    for key in FACTS:
        if key not in document:
            raise InputError(path, key, "missing; an older version may have written this file", "run the batch again")
    return document


def read_metrics(document: SummaryDocument, path: Path) -> tuple[Metric, ...]:
    """Return the metrics of a campaign as declared in summary.json. Raises InputError."""
    try:
        return tuple(
            Metric(
                name=name,
                expression=Expression(fact["expression"], (str(path), f"metrics.{name}.expression")),
                reduction=fact["reduction"],
                unit=fact["unit"],
                description=describe_metric(fact),
                condition=Expression(fact["condition"], (str(path), f"metrics.{name}.condition"))
                if "condition" in fact
                else None,
                delay=fact.get("delay", 0.0),
            )
            for name, fact in document["metrics"].items()
        )
    except (AttributeError, KeyError, TypeError) as error:
        raise InputError(path, "metrics", "not in the form that perilune batch writes", NEW_FOLDER) from error
