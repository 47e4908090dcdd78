"""Hand-written batches to compare, in the form of `perilune batch`, without simulation."""

import tomllib
from pathlib import Path

import numpy as np

from perilune.analysis.campaigns.definition.file import parse_campaign
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.campaigns.definition.table import TomlTable
from perilune.analysis.campaigns.execute.campaign_result import CampaignResult
from perilune.analysis.campaigns.folder.shard_files import with_draws, write_draws
from perilune.analysis.campaigns.trials import TrialTable
from perilune.analysis.runtime.system.options import SystemOptions

DIGEST = "0123456789abcdef" * 4
POSITION = [f"ship.position[{i}]" for i in (1, 2, 3)]
VELOCITY = [f"ship.velocity[{i}]" for i in (1, 2, 3)]
DIRECTION = [f"pilot.thrust_direction[{i}]" for i in (1, 2, 3)]
SIGNALS = [*POSITION, *VELOCITY, "ship.mass", "pilot.thrust", *DIRECTION, "pilot.status", "checker.x_error_ratio"]
UNITS = {"position": "m", "velocity": "m/s", "mass": "kg", "thrust": "N"}
TARGET = np.array([10.0, -20.0, 100.0])
END = 20.0
CAMPAIGN = """
system = "ship"
description = "Ships that go somewhere"
trials = {trials}
seed = {seed}
[draw.offset]
distribution = "uniform"
low = -1
high = 1
[metric.miss]
expression = "norm(ship.position[1] - 10, ship.position[2] + 20, ship.position[3] - 100)"
reduction = "final"
unit = "m"
description = "how far off"
[metric.propellant]
expression = "100 - ship.mass"
reduction = "final"
unit = "kg"
[metric.tilt]
expression = "ship.tilt"
reduction = "max"
unit = "rad"
[metric.pinpoint]
expression = "ship.position[1] < 12 and ship.position[1] > 8"
reduction = "final"
[metric.x_error_over_sigma]
expression = "checker.x_error_ratio"
reduction = "final"
[record]
{final}
{sampling}
[success]
expression = "miss <= 3"
"""
SAMPLING = "every = 2\nsignals = {signals}\ntrials = {traced}"


def facts(campaign, variants, targets=True):
    """Return the provenance of the hand-written batch, as `perilune.analysis.campaigns.folder.provenance` would."""
    names = dict.fromkeys([*campaign.record.final, *campaign.record.signals])
    target = {f"pilot.target_{kind}[{i + 1}]": float(value) for kind, at in
              (("position", TARGET), ("velocity", np.zeros(3))) for i, value in enumerate(at)}  # fmt: skip
    record = campaign.record
    return ({} if campaign.group is None else {"group": campaign.group}) | {
        "description": campaign.description,
        "success": campaign.success.text,
        "metrics": {
            metric.name: {
                "expression": metric.expression.text,
                "reduction": metric.reduction,
                "unit": metric.unit,
                "description": metric.description,
                "truth": metric.expression.is_truth,
            }
            for metric in campaign.metrics
        },
        "record": {
            "every": record.every, "signals": list(record.signals), "trials": record.trials, "traces": record.traces,
        },
        "signals": {
            name: {
                "unit": UNITS.get(name.rpartition(".")[2].partition("[")[0]),
                "type": "Integer" if name.endswith("status") else "Real",
            }
            for name in names
        },
        "targets": {variant: target if targets else {} for variant in variants},
    }  # fmt: skip


def flight(source, end, mass):
    """Return signals of a flight from 1 km before its target to ``end``, rows every 0.5 s,
    thinned as [record] every = 2."""
    time = np.arange(0.0, END + 0.25, 0.5)
    fraction = time / END
    start = np.array([-1000.0 + 30.0 * source.normal(), 40.0 * source.normal(), 500.0])
    collected = {"time": time}
    for k, name in enumerate(POSITION):
        collected[name] = start[k] + (end[k] - start[k]) * fraction
    for k, name in enumerate(VELOCITY):
        collected[name] = np.full(time.size, (end[k] - start[k]) / END)
    collected["ship.mass"] = 100.0 + (mass - 100.0) * fraction
    collected["pilot.thrust"] = 50.0 + 5.0 * source.normal() + 10.0 * fraction
    angle = 0.3 + 0.1 * source.normal() + 0.5 * fraction
    collected |= dict(zip(DIRECTION, (np.cos(angle), np.zeros(time.size), np.sin(angle)), strict=True))
    collected["pilot.status"] = np.where(fraction > 0.9, 1.0, 0.0)
    collected["checker.x_error_ratio"] = source.normal(size=time.size)
    return {name: values[::2] for name, values in collected.items()}


def sample_batch(
    trials=40,
    variants=("alpha", "beta", "gamma"),
    seed=7,
    noise=1.0,
    traced=12,
    final=True,
    text=CAMPAIGN,
    targets=True,
    flat=False,
) -> CampaignResult:
    """Return a batch in which alpha is good, beta worse, gamma off to one side; ``noise`` scales all misses.

    ``flat`` ones are horizontal.
    """
    names = [*POSITION, *VELOCITY, "ship.mass"] if final else []
    sampling = SAMPLING.format(signals=SIGNALS, traced=traced) if traced else ""
    campaign = parse_campaign(
        TomlTable(
            tomllib.loads(
                text.format(trials=trials, seed=seed, final=f"final = {names}" if names else "", sampling=sampling)
            ),
            "test.toml",
        )
    )
    plan = BatchPlan("ship", campaign, SystemOptions(), DIGEST[::-1])
    collected = {}
    for number, variant in enumerate(variants):
        source = np.random.default_rng(100 * seed + number)
        errors = noise * (1.0 + 0.5 * number) * source.normal(size=(trials, 3)) + [0.4 * number, 0.0, 0.0]
        if flat:
            errors[:, 2] = 0.0
        ends = TARGET + errors
        speeds = 0.1 * source.normal(size=(trials, 3))
        mass = 60.0 - number + 0.5 * source.normal(size=trials)
        miss = np.linalg.norm(errors, axis=1)
        metrics = {
            "miss": miss,
            "propellant": 100.0 - mass,
            "tilt": 0.1 + 0.01 * source.random(trials),
            "pinpoint": (np.abs(errors[:, 0]) < 2.0).astype(float),
            "x_error_over_sigma": source.normal(size=trials),
        }
        columns = np.concatenate([ends, speeds, mass[:, np.newaxis]], axis=1)
        collected[variant] = TrialTable.of(
            {
                "trial": np.arange(trials),
                "status": ["finished" if value <= 3.0 else "stop_time (pilot.status 2)" for value in miss],
                "success": miss <= 3.0,
                "message": [""] * trials,
                "end_time": np.full(trials, END),
                **{f"final.{name}": columns[:, k] for k, name in enumerate(names)},
                **{f"metric.{metric.name}": metrics[metric.name] for metric in campaign.metrics},
            },
            {k: flight(source, ends[k], mass[k]) for k in range(min(traced, trials))},
        )
    provenance = {
        "system": "ship", "system_sha256": DIGEST, "campaign": "test.toml", "campaign_sha256": plan.campaign_sha256,
        "parameter_sets": [], "set": {}, "variant": None, "start_time": 0.0, "steps": 40, "trials": trials,
        "seed": seed, "step": 0.5, "algorithm": "sequential", "perilune": "0.0.1",
        "fmus": {variant: {"ship": DIGEST, "pilot": variant.ljust(64, "0")} for variant in variants},
    } | facts(campaign, variants, targets)  # fmt: skip
    sampled = plan.values_of(range(trials))
    return CampaignResult(plan, {name: with_draws(rows, sampled) for name, rows in collected.items()}, provenance)


def write_sample(folder: Path, **options) -> CampaignResult:
    """Write a sample batch to a folder, as `perilune batch --output` does."""
    result = sample_batch(**options)
    write_draws(result.plan, folder, result.plan.campaign.trials)
    result.write(folder)
    return result
