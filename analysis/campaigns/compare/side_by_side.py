"""Functions that read stored batches and compare them; only batches with the same draws are comparable."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np

from ....common.errors import InputError, suggestion
from ..folder.stored import StoredBatch, read_batch
from ..lost_trials import lost_lines
from .campaign_comparison import CampaignComparison, Contender

DIFFERENCES = {
    "system": "simulate different systems",
    "success": "define success differently",
    "seed": "have different seeds, so their components' random errors differ",
    "step": "have different steps",
    "algorithm": "use different co-simulation algorithms",
}
DEFINITION = ("expression", "reduction", "condition", "delay")  # definition of a metric


Result = TypeVar("Result", bound=CampaignComparison)


def compare(folders: Sequence[Path], reference: str | None = None) -> CampaignComparison:
    """See `compare_folders`."""
    return compare_folders(CampaignComparison, folders, reference)


def compare_folders(make: type[Result], folders: Sequence[Path], reference: str | None = None) -> Result:
    """Read the batches in folders and return the comparison of their variants, an instance of ``make``.

    ``reference`` names the reference variant, by default the first. Raises InputError for a folder without a batch, and
    for batches with different draws.
    """
    resolved = [folder.resolve() for folder in folders]
    for folder, path in zip(folders, resolved, strict=True):
        if resolved.count(path) > 1:
            raise InputError(folder, "", "given twice", "give each folder once")
    batches = [read_batch(folder) for folder in folders]
    for batch in batches[1:]:
        _check_draws(batches[0], batch)
        _check_units(batches[0], batch)
    variants = list(dict.fromkeys(variant for batch in batches for variant in batch.variants))
    if reference is not None and reference not in variants:
        raise InputError("`reference`", reference, "no such variant", suggestion(reference, variants))
    named = dict(zip(_distinct_names(resolved), batches, strict=True))
    contenders = {}
    for index, (name, batch) in enumerate(named.items()):
        for variant in batch.variants:
            label = _label(name, variant, several=len(batches) > 1, single=len(variants) == 1)
            contenders[label] = Contender(label, batch, variant, index, variants.index(variant))
    lost = lost_lines({label: Counter(contender.trials.statuses) for label, contender in contenders.items()})
    return make(contenders, named, reference or variants[0], (*_notes(named), *lost))


def _label(folder: str, variant: str, *, several: bool, single: bool) -> str:
    """Return a contender's label from the names that distinguish it: variant, folder, or both."""
    if not several:
        return variant
    return folder if single else f"{folder}: {variant}"


def _check_draws(first: StoredBatch, other: StoredBatch) -> None:
    """Reject batches with different draws or numbers of trials."""
    count, other_count = (len(next(iter(batch.variants.values()))) for batch in (first, other))
    problem = ""
    if count != other_count:
        problem = f"{other_count} trials, {count} in {first.folder}"
    elif set(first.draws) != set(other.draws):
        name = min(set(first.draws) ^ set(other.draws))
        problem = f"only one of this folder and {first.folder} draws {name}"
    else:
        for name, values in first.draws.items():
            if not np.array_equal(values, other.draws[name]):
                problem = f"the samples of {name} differ from those in {first.folder}"
                break
    if problem:
        raise InputError(
            other.folder, "draws", problem, "compare campaigns with the same draws, number of trials and seed"
        )


def _check_units(first: StoredBatch, other: StoredBatch) -> None:
    units = {metric.name: metric.unit for metric in first.metrics}
    for metric in other.metrics:
        if units.get(metric.name, metric.unit) != metric.unit:
            problem = f"its unit is {metric.unit}, but {units[metric.name]} in {first.folder}"
            raise InputError(other.folder, f"metric {metric.name}", problem, "compare metrics in the same unit")


def _notes(batches: Mapping[str, StoredBatch]) -> Iterator[str]:
    name, first = next(iter(batches.items()))
    for other_name, other in batches.items():
        pair = f"{name} and {other_name}"
        one: Mapping[str, object] = first.document
        another: Mapping[str, object] = other.document
        for key, words in DIFFERENCES.items():
            if one[key] != another[key]:
                yield f"{pair} {words}: {one[key]} and {another[key]}"
        if None not in (first.group, other.group) and first.group != other.group:
            yield f"{pair} group trials by different values: {first.group} and {other.group}"
        own = {metric.name: metric for metric in first.metrics}
        for metric in other.metrics:
            known = own.get(metric.name, metric)
            if any(getattr(known, key) != getattr(metric, key) for key in DEFINITION):
                yield f"{pair} define the metric {metric.name} differently"
        if other.foreign_traces:
            yield f"{other_name} contains {other.foreign_traces} traces of another batch, which are omitted"


def _distinct_names(paths: Sequence[Path]) -> list[str]:
    """Return the shortest trailing portions of paths that distinguish the paths."""
    for length in range(1, max(len(path.parts) for path in paths) + 1):
        names = ["/".join(path.parts[-length:]) for path in paths]
        if len(set(names)) == len(names):
            break
    return [os.fsencode(name).decode("utf-8", "replace") for name in names]
