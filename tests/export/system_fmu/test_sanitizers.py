"""The C of system FMUs under the address and undefined-behaviour sanitizers, in two threads: `make sanitize`.

Truth: the sanitizers, which end the process; the same FMU without them.
"""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import pytest

from tests.runtime.fused.test_sanitizers import CAMPAIGNS, find_file
from tests.support.lengths import LONG
from tests.support.native.sanitizers import find_compiler
from tests.support.native.system_fmus import build_one

ROOT = Path(__file__).parents[3]
FLIGHTS = """
import sys
from concurrent.futures import ThreadPoolExecutor
import numpy as np
from tests.support.native.system_fmus import Slave

def fly(path, folder):
    slave = Slave(path, folder)
    step = float(slave.description.defaultExperiment.stepSize)
    names = [each.name for each in slave.description.modelVariables if each.causality in ("output", "local")]
    rows = []
    for number in range(300):
        if number == 100:
            state = slave.fmu.getFMUstate()
            slave.fmu.setFMUstate(slave.fmu.deSerializeFMUstate(slave.fmu.serializeFMUstate(state)))
        slave.step(step)
        rows.append([float(slave.get(name)) for name in names])
    return np.array(rows)

plain, checked, folder = sys.argv[1:]
expected = fly(plain, folder + "/plain")
with ThreadPoolExecutor(2) as pool:
    for rows in pool.map(lambda number: fly(checked, f"{folder}/{number}"), range(2)):
        assert np.array_equal(rows, expected)
"""


@pytest.mark.skipif(not LONG, reason="half a minute for each system: make sanitize")
@pytest.mark.skipif(shutil.which("gcc") is None, reason="needs gcc, which has a library to preload")
@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("system", CAMPAIGNS)
def test_no_sanitizer_objects(system, tmp_path):
    exposed = ["guidance.finished"] if system == "lunar_terminal_guidance" else []
    plain = build_one(tmp_path / "plain.fmu", system, exposed=exposed)
    folder = Path(fmpy.extract(str(plain), str(tmp_path / "sources"))) / "sources"
    main = f"{fmpy.read_model_description(str(plain)).coSimulation.modelIdentifier}.c"
    command = [*find_compiler(), "-fno-tree-vectorize", "-fPIC", "-shared", main, "-lm", "-o", "checked.so"]
    subprocess.run(command, cwd=folder, check=True)
    checked = tmp_path / "checked.fmu"
    with zipfile.ZipFile(plain) as files, zipfile.ZipFile(checked, "w") as changed:
        for name in files.namelist():
            library = (folder / "checked.so").read_bytes()
            changed.writestr(name, library if name.startswith("binaries/") else files.read(name))
    runtime = [find_file("libasan.so"), find_file("libstdc++.so")]
    environment = os.environ | {"LD_PRELOAD": " ".join(runtime), "ASAN_OPTIONS": "detect_leaks=0"}
    ended = subprocess.run(
        [sys.executable, "-c", FLIGHTS, plain, checked, tmp_path],
        env=environment,
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr[-3000:]
