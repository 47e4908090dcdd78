"""Each block's check, simulated in both flavours by FMPy, as by another tool.

Truth: checks/NAME.csv next to the block, computed by tests/support/checks without a line of `fmus_src`, within the
tolerances of checks/NAME.toml. A recomputed check equals the stored check within these tolerances, or to 1e-12 of the
largest value of a column.
"""

import io
import subprocess
import sys
import zipfile

import fmpy
import numpy as np
import pytest
from fmpy.util import read_csv
from lxml import etree

from perilune.common.paths import ROOT, shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.evidence.check import read_check
from perilune.fmus_src.evidence.manifest import FOLDER
from tests.support.checks.check import read_declarations
from tests.support.checks.truths import TRUTHS
from tests.support.lengths import LONG, either

FLOWN = [
    (name, flavour)
    for number, name in enumerate(TRUTHS)
    for flavour in ("native", "python")
    if (flavour == "python" or not catalogue()[name].python_only)
    and (LONG or flavour == "native" or catalogue()[name].python_only or number % 6 == 0)
]
RECOMPUTED = [*TRUTHS][:: either(1, 4)]


@pytest.mark.parametrize(("name", "flavour"), FLOWN)
def test_fmpy_reproduces_the_evidence_of_an_fmu(name, flavour, tmp_path):
    """The independent trajectory within its tolerances, the FMU's own outputs bit by bit."""
    fmu = shipped_fmu(name, flavour)
    with zipfile.ZipFile(fmu) as archive:
        carried = {name: archive.read(name) for name in archive.namelist() if name.startswith(FOLDER)}
    declared = read_declarations(check_file(name, ".toml").read_bytes())
    assert carried[f"{FOLDER}/check.csv"] == check_file(name, ".csv").read_bytes()
    (tmp_path / "check.csv").write_bytes(carried[f"{FOLDER}/check.csv"])
    reference = read_csv(tmp_path / "check.csv")
    inputs = [name for name in reference.dtype.names if name not in declared["tolerances"]]
    parameters = etree.fromstring(carried[f"{FOLDER}/check.ssv"]).findall(".//{*}Parameter")
    (check, *others) = etree.fromstring(carried[f"{FOLDER}/check.exp"]).findall("Experiment")
    step, stop = (float(check.find("TransientSimulation").get(key)) for key in ("stepSize", "stopTime"))
    actual = fmpy.simulate_fmu(
        str(fmu),
        start_values={parameter.get("name"): parameter[0].get("value") for parameter in parameters},
        input=reference[inputs],
        output=list(declared["tolerances"]),
        step_size=step,
        output_interval=step,
        stop_time=stop,
    )
    assert actual["time"].tolist() == reference["time"].tolist()
    assert {signal.get("name") for signal in check.iter("Signal")} == set(declared["tolerances"])
    for signal in check.iter("Signal"):
        column = signal.get("name")
        permitted = float(signal.get("absolute")) + float(signal.get("relative")) * np.abs(reference[column])
        error = np.abs(actual[column].astype(float) - reference[column])
        row = int(np.argmax(error - permitted))
        assert bool((error <= permitted).all()), (
            f"{column} at {reference['time'][row]} s: {error[row]} > {permitted[row]}"
        )
    assert len(others) == (0 if catalogue()[name].python_only else 1)
    if others:
        recorded = read_table(carried[f"{FOLDER}/outputs.csv"].decode())
        for column in declared["tolerances"]:
            assert np.array_equal(actual[column].astype(float), recorded[column], equal_nan=True), column


@pytest.mark.parametrize("name", RECOMPUTED)
def test_a_check_is_what_its_truth_computes(name):
    kind, truth = TRUTHS[name]
    stored, computed = ROOT / "fmus_src" / kind / "checks" / f"{name}.csv", truth()
    expected, actual = read_table(stored.read_text()), read_table(computed.csv())
    assert stored.with_suffix(".toml").read_text() == computed.toml()
    assert actual.dtype.names == expected.dtype.names
    tolerances = read_declarations(computed.toml().encode())["tolerances"]
    for column in expected.dtype.names:
        permitted = 1e-12 * np.nanmax(np.abs(expected[column]))  # a sample may be not finite
        if column in tolerances:
            declared = tolerances[column]
            permitted = np.maximum(permitted, declared["absolute"] + declared["relative"] * np.abs(expected[column]))
        same = np.isnan(actual[column]) & np.isnan(expected[column])
        assert np.all(same | (np.abs(actual[column] - expected[column]) <= permitted)), column


def check_file(name, suffix):
    return ROOT / "fmus_src" / TRUTHS[name][0] / "checks" / f"{name}{suffix}"


def read_table(text):
    return np.genfromtxt(io.StringIO(text), delimiter=",", names=True, deletechars="", replace_space=" ")


def test_truths_import_nothing_of_the_blocks():
    script = "import sys, tests.support.checks.truths; sys.exit(any('fmus_src' in name for name in sys.modules))"
    subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True)


def test_each_block_has_a_check():
    assert {name for name, block in catalogue().items() if read_check(block)} == set(TRUTHS) == set(catalogue())
