"""Campaign whose faults change tunable parameters.

Truth: each trial's ramp computed from its draws, whose slope the fault changes between two times; the replay.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import perilune
from tests.support.builders import component, connection, document, pack, system

CAMPAIGN = """
system = "s"
trials = 8
seed = 5
[draw."ramp.slope"]
distribution = "uniform"
low = 1
high = 3
[draw.t0]
distribution = "uniform"
low = 0.3
high = 1.5
[draw.size]
distribution = "normal"
mean = 0
sigma = 1
[fault.steeper]
connector = "ramp.slope"
kind = "bias"
value = "size"
start = "t0"
[metric.last]
expression = "ramp.y"
reduction = "final"
[success]
expression = "last > 4"
"""
STEP, ROWS = 0.25, 9


@pytest.fixture
def ssp(tiny: Path, tmp_path: Path) -> Path:
    components = (
        component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer"),
        component("gain", "gain", "input u Real m; output y Real m"),
    )
    text = document(system(*components, connections=connection("ramp.y", "gain.u")), stop=STEP * (ROWS - 1), step=STEP)
    return pack(tmp_path / "s.ssp", tiny, text)


def test_every_trial_changes_a_parameter(ssp: Path, tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text(CAMPAIGN)
    batch = perilune.batch(ssp, str(tmp_path / "c.toml"), workers=1, output=tmp_path / "out")
    table = batch.table()
    time = STEP * np.arange(ROWS - 1)
    for trial, row in enumerate(table.to_pylist()):
        rises = row["draw.ramp.slope"] + np.where(time >= row["draw.t0"], row["draw.size"], 0.0)
        assert row["metric.last"] == pytest.approx(1.0 + STEP * rises.sum(), rel=1e-12)
        if trial < 2:
            assert perilune.replay(tmp_path / "out", trial).differences == ()


def test_a_fixed_parameter_is_refused(ssp: Path, tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text(CAMPAIGN.replace('connector = "ramp.slope"', 'connector = "ramp.start"'))
    words = "a parameter that is fixed after initialisation; set it before the start by set ramp.start=VALUE"
    with pytest.raises(perilune.InputError, match=re.escape(words)):
        perilune.batch(ssp, str(tmp_path / "c.toml"), workers=1)
