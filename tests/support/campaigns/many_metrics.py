"""Folders of campaigns with many metrics for `show`, in the form of a batch, without simulation."""

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np

from perilune.analysis.campaigns.definition.file import parse_campaign
from perilune.analysis.campaigns.definition.table import TomlTable
from perilune.analysis.campaigns.folder.campaign_folder import CampaignFolder
from perilune.analysis.campaigns.trials import TrialTable
from tests.support.pages.comparison_samples import END, sample_batch
from tests.support.pages.comparison_samples import facts as metadata_of

HEAD = """
system = "ship"
description = "{description}"
trials = {trials}
seed = 3
[draw.offset]
distribution = "uniform"
low = -1
high = 1
[success]
expression = "m0 <= 1.5"
"""
METRIC = """
[metric.{name}]
expression = "ship.mass"
reduction = "final"
unit = "{unit}"
"""
UNITS = ("m", "rad", "kg", "1")


def metric_columns(source: np.random.Generator, trials: int, metrics: int) -> dict[str, np.ndarray]:
    """Draw metrics of every kind: normal, over decades, whole numbers, related to the first,
    with nan and infinite ones."""
    first = source.normal(size=trials)
    columns = {}
    for number in range(metrics):
        kind, noise = number % 5, source.normal(size=trials)
        columns[f"m{number}"] = {
            0: first if number == 0 else noise,
            1: np.exp(3.0 * noise),
            2: np.rint(4.0 * noise),
            3: 0.7 * first + 0.7 * noise,
            4: np.where(noise > 2.0, np.nan, np.where(noise < -2.5, np.inf, noise)),
        }[kind]
    return columns


def write_many(
    folder: Path,
    trials: int,
    size: int,
    variants: tuple[str, ...] = ("alpha",),
    metrics: int = 40,
    description: str = "many",
) -> None:
    """Write ``trials`` of each variant in shards of ``size``; a trial is a success where its
    first metric is at most 1.5."""
    sample = sample_batch(trials=min(trials, size), variants=variants, traced=0, final=False)
    text = HEAD.format(trials=trials, description=description) + "".join(
        METRIC.format(name=f"m{number}", unit=UNITS[number % len(UNITS)]) for number in range(metrics)
    )
    campaign = replace(
        parse_campaign(TomlTable(tomllib.loads(text), "test.toml")), trials=trials, draw_scheme="counter"
    )
    plan = replace(sample.plan, campaign=campaign)
    provenance = {**sample.provenance, "trials": trials, "draw_scheme": "counter", **metadata_of(campaign, variants)}
    source, stored = np.random.default_rng(1), CampaignFolder(folder, provenance)
    for shard in range(-(-trials // size)):
        numbers = np.arange(shard * size, min((shard + 1) * size, trials))
        rows = {}
        for number, name in enumerate(variants):
            columns = metric_columns(source, numbers.size, metrics)
            columns["m0"] = columns["m0"] + 0.5 * number
            success = columns["m0"] <= 1.5
            rows[name] = TrialTable.of(
                {
                    "trial": numbers,
                    "status": np.where(success, "finished", "stop_time").tolist(),
                    "success": success,
                    "message": [""] * numbers.size,
                    "end_time": np.full(numbers.size, END),
                    **{f"metric.{metric}": values for metric, values in columns.items()},
                }
            )
        stored.write(shard, plan, rows)
    (folder / "summary.json").write_text(json.dumps({**provenance, "variants": {name: {} for name in variants}}))
