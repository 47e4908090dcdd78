"""Metadata of a batch on signals and metrics along named axes of a system.

Truth: the names of the landing-site frame's axes in the system's annotation.
"""

from __future__ import annotations

import tomllib

import pytest

from perilune.analysis.campaigns.definition.file import parse_campaign
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.campaigns.definition.table import TomlTable
from perilune.analysis.campaigns.execute.metadata import campaign_metadata
from perilune.analysis.campaigns.trial_columns import describe_column, describe_metric
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system

NAME = "lunar_terminal_guidance"
CAMPAIGN = f"""
system = "{NAME}"
trials = 2
seed = 1
[metric.sink]
expression = "plant.velocity[3]"
reduction = "min"
unit = "m/s"
[metric.drift]
expression = "plant.velocity[2]"
reduction = "final"
unit = "m/s"
description = "across the flight"
[metric.speed]
expression = "abs(plant.velocity[3])"
reduction = "final"
unit = "m/s"
[success]
expression = "speed < 1"
[record]
final = ["plant.velocity[1]", "plant.mass"]
"""


@pytest.mark.usefixtures("fmus")
def test_a_metric_that_is_an_element_is_called_by_its_axis():
    campaign = parse_campaign(TomlTable(tomllib.loads(CAMPAIGN), "test.toml"))
    metadata = campaign_metadata(BatchPlan(NAME, campaign, SystemOptions()), {"default": prepare_system(NAME)})
    metrics = metadata["metrics"]
    assert {name: fact.get("axis") for name, fact in metrics.items()} == {"sink": "up", "drift": "west", "speed": None}
    described = {name: describe_metric(fact) for name, fact in metrics.items()}
    assert described == {"sink": "min of plant.velocity up", "drift": "across the flight", "speed": ""}
    assert describe_column("metric.sink", metadata).meaning == "min of plant.velocity up"
    assert describe_column("metric.speed", metadata).meaning == "final of abs(plant.velocity[3])"
    assert metadata["signals"]["plant.velocity[1]"]["axis"] == "north"
    assert "axis" not in metadata["signals"]["plant.mass"]
