"""Hand-written results for the reports, without simulation."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np

from perilune.analysis.campaigns.definition.file import parse_campaign
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.campaigns.definition.table import TomlTable
from perilune.analysis.campaigns.execute.campaign_result import CampaignResult
from perilune.analysis.campaigns.folder.shard_files import with_draws
from perilune.analysis.campaigns.trials import TrialTable
from perilune.analysis.documents.of.batch.batch import batch_document
from perilune.analysis.documents.render.html import write_document
from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.runtime.system.options import SystemOptions
from tests.support.pages.comparison_samples import facts as metadata_of

DIGEST = "0123456789abcdef" * 4
HEAD = 'system = "ship"\ntrials = {trials}\nseed = 7\n'
DRAWS = """
[draw.offset]
distribution = "uniform"
low = -1
high = 1
[draw."ship.mass"]
distribution = "normal"
mean = 10
sigma = 1
[derive]
twice = "2 * offset"
"""
METRICS = """
[metric.miss]
expression = "ship.position[1]"
reduction = "final"
unit = "m"
description = "how far off"
[metric.tilt]
expression = "ship.tilt"
reduction = "max"
unit = "rad"
[success]
expression = "miss <= 1"
"""


def run_result(rows: int = 200, status: str = "finished", message: str = "") -> FlightResult:
    """Return a flight of a `ship` that turns, with a nested `crew.cook` and a system connector; rows may be 0."""
    time = 0.5 * np.arange(rows)
    spike = np.where(np.arange(rows) == 3, 1e6, np.sin(time))
    signals = {
        "ship.position[1]": 1000.0 - 20.0 * time,
        "ship.position[2]": 0.5 * time**2,
        "ship.position[3]": 50.0 + time,
        "ship.tilt": 0.01 * time,
        "ship.mass": np.full(rows, 12.5),
        "ship.status": np.minimum(np.arange(rows), 2).astype(float),
        "crew.cook.position[1]": 1000.0 - 20.0 * time,
        "crew.cook.position[2]": 0.5 * time**2,
        "crew.cook.position[3]": 50.0 + time,
        "crew.cook.spike": spike,
        "crew.cook.awake": (np.arange(rows) % 2).astype(float),
        "finished": (np.arange(rows) == rows - 1).astype(float),
    }
    units = {name: "m" if "position" in name else None for name in signals} | {"ship.tilt": "rad", "ship.mass": "kg"}
    types = dict.fromkeys(signals, "Real")
    types |= {"ship.status": "Integer", "crew.cook.awake": "Boolean", "finished": "Boolean"}
    provenance = {
        "system": "ship",
        "system_sha256": DIGEST,
        "fmus": {
            name: {"fmu": f"{name}_block", "sha256": DIGEST[::-1], "guid": "{}"} for name in ("ship", "crew.cook")
        },
        "parameters": {"ship.length": 3.25, "ship.sails": 2, "ship.armed": False, "ship.name": "<b>Beagle</b>"},
        "start_time": 0.0,
        "step": 0.5,
        "faults": [],
        "algorithm": "sequential",
        "perilune": "0.0.1",
    }
    return FlightResult(
        time=time,
        signals=signals,
        units=units,
        types=types,
        status=status,
        message=message,
        provenance=provenance,
    )


CASES = """
[draw.case]
distribution = "choice"
values = [1, 2, 0.5]
[group]
by = "case"
"""


def batch_result(outcomes: dict[str, list[tuple[bool, float, float]]], text: str = DRAWS + METRICS) -> CampaignResult:
    """Return a batch from (success, miss, tilt) of every trial by variant."""
    trials = len(next(iter(outcomes.values())))
    campaign = parse_campaign(TomlTable(tomllib.loads(HEAD.format(trials=trials) + text), "test.toml"))
    if list(outcomes) != ["default"]:
        campaign = replace(campaign, compare={"guidance": tuple(outcomes)})
    names = [metric.name for metric in campaign.metrics]
    collected = {
        variant: TrialTable.of(
            {
                "trial": np.arange(len(rows)),
                "status": ["finished" if row[0] else "stop_time (ship.status 2)" for row in rows],
                "success": np.array([row[0] for row in rows]),
                "message": [""] * len(rows),
                "end_time": np.ones(len(rows)),
                **{f"metric.{name}": np.array([row[1 + k] for row in rows]) for k, name in enumerate(names)},
            }
        )
        for variant, rows in outcomes.items()
    }
    provenance = {
        "system": "ship",
        "system_sha256": DIGEST,
        "campaign": "test.toml",
        "trials": trials,
        "seed": 7,
        "step": 0.5,
        "algorithm": "sequential",
        "fmus": {variant: {"ship": DIGEST, "guidance": variant} for variant in outcomes},
        "perilune": "0.0.1",
        "success": campaign.success.text,
        "metrics": metadata_of(campaign, outcomes)["metrics"],
    }
    plan = BatchPlan("ship", campaign, SystemOptions())
    rows = {name: with_draws(rows, plan.values_of(range(len(rows)))) for name, rows in collected.items()}
    return CampaignResult(plan, rows, provenance)


def grouped_batch(trials: int = 60) -> CampaignResult:
    """Return the mixed batch with a drawn `case` by which trials are grouped."""
    return mixed_batch(trials, CASES + DRAWS + METRICS)


def mixed_batch(trials: int = 40, text: str = DRAWS + METRICS) -> CampaignResult:
    """Return a batch of two variants: one that always succeeds, one that fails where the draw
    `offset` is large either way."""
    source = np.random.default_rng(5)
    probe = batch_result({"steady": [(True, 0.0, 0.0)] * trials}, text)
    offset = probe.plan.draws.columns["offset"]
    steady = [(True, float(source.lognormal(-3, 2)), float(source.normal())) for _ in range(trials)]
    shaky = [(bool(abs(x) < 0.6), float(10 ** (4 * abs(x) - 2)), 0.1) for x in offset]
    return batch_result({"steady": steady, "shaky": shaky}, text)


def write_batch_page(batch: CampaignResult, path: Path, title: str = "Batch") -> None:
    """Write the page of a batch with a ``title``."""
    write_document(replace(batch_document(batch), title=title), path)
