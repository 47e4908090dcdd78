"""FMUs of the catalogue in FMPy: valid, and running from their declared start values with their proposed step.

`make long` covers all FMUs, `make test` every twentieth of each flavour, with different blocks.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from perilune.fmus_src.catalogue import catalogue
from tests.support.lengths import either

BLOCKS = list(catalogue().items())
FIRST = {"python": 0, "native": either(0, 3)}
EVERY = either(1, 20)
STEPS = 20
# In another process, which exits before pythonfmu's destructors.
SCRIPT = """
import json, os, sys
import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

steps = int(sys.argv[1])
found = {}
for path in sys.argv[2:]:
    step = float(read_model_description(path).defaultExperiment.stepSize)
    rows = simulate_fmu(path, stop_time=step * steps, step_size=step, output_interval=step)
    values = np.array([list(row) for row in rows.tolist()])
    found[path] = [validate_fmu(path), len(rows), bool(np.isfinite(values).all())]
print(json.dumps(found), flush=True)
os._exit(0)
"""


@pytest.fixture(scope="module", params=["python", "native"])
def actual(request: pytest.FixtureRequest, fmus: Path) -> dict[str, list]:
    """Return FMPy's report on each FMU: problems, rows of its simulation, finiteness of all values."""
    folder = fmus.with_name(request.param)
    if request.param == "native" and not folder.is_dir():
        pytest.skip("native FMUs are not built")
    selected = BLOCKS[FIRST[request.param] :: EVERY]
    names = [name for name, block in selected if request.param == "python" or not block.python_only]
    paths = {name: str(folder / f"{name}.fmu") for name in names}
    command = [sys.executable, "-c", SCRIPT, str(STEPS), *paths.values()]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    answers = json.loads(done.stdout.splitlines()[-1])
    return {name: answers[path] for name, path in paths.items()}


def test_fmpy_finds_no_fault(actual: dict[str, list]) -> None:
    assert {name: problems for name, (problems, _, _) in actual.items() if problems} == {}


def test_fmpy_simulates_on_declared_starts(actual: dict[str, list]) -> None:
    assert {name: (rows, finite) for name, (_, rows, finite) in actual.items()} == dict.fromkeys(
        actual, (STEPS + 1, True)
    )
