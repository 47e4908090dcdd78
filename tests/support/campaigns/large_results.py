"""Folders of many trials in the form of a batch, without simulation."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np

from perilune.analysis.campaigns.folder.campaign_folder import CampaignFolder
from tests.support.campaigns.trial_tables import changed
from tests.support.pages.comparison_samples import sample_batch

SIZE = 5000  # trials of a shard: a batch's shards have no more


def write_large(folder: Path, trials: int) -> None:
    """Write ``trials`` trials of one variant, alpha, whose metric miss is the square of a normal number."""
    sample = sample_batch(trials=min(trials, SIZE), variants=("alpha",), traced=0)
    plan = replace(sample.plan, campaign=replace(sample.plan.campaign, trials=trials, draw_scheme="counter"))
    provenance = {**sample.provenance, "trials": trials, "draw_scheme": "counter"}
    source, stored = np.random.default_rng(1), CampaignFolder(folder, provenance)
    alpha = sample.trials["alpha"]
    for shard in range(-(-trials // SIZE)):
        numbers = np.arange(shard * SIZE, min((shard + 1) * SIZE, trials))
        part = alpha.part(range(numbers.size))
        part = changed(part, {"trial": numbers, "metric.miss": source.normal(size=numbers.size) ** 2})
        stored.write(shard, plan, {"alpha": part})
    (folder / "summary.json").write_text(json.dumps({**provenance, "variants": {"alpha": {}}}))
