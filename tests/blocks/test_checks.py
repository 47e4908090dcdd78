"""Each block's check, flown in both flavours by FMPy as another tool would.

Truth: checks/NAME.csv next to the block, computed by tests/support/checks without a line of `fmus_src`, within the
tolerances of checks/NAME.toml. Recomputed, a check is the stored one within these, or to 1e-12 of a column's largest.
"""

import io
import subprocess
import sys
import zipfile

import fmpy
import numpy as np
import pytest
from fmpy import read_model_description
from fmpy.util import read_csv

from perilune.fmus_src.catalogue import blocks_in_file, catalogue
from perilune.fmus_src.checks import ARCHIVE_FOLDER, check_files
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.paths import ROOT, shipped_fmu
from tests.support.checks.check import read_declarations
from tests.support.checks.truths import TRUTHS

FLOWN = [
    (name, flavour)
    for name in TRUTHS
    for flavour in (("python",) if catalogue()[name].python_only else ("native", "python"))
]


@pytest.mark.parametrize(("name", "flavour"), FLOWN)
def test_an_fmu_passes_the_check_that_it_carries(name, flavour, tmp_path):
    fmu = shipped_fmu(name, flavour)
    with zipfile.ZipFile(fmu) as archive:
        carried = {name: archive.read(name) for name in archive.namelist() if name.startswith("extra/")}
    assert carried == check_files(catalogue()[name])
    (tmp_path / "check.csv").write_bytes(carried[f"{ARCHIVE_FOLDER}/check.csv"])
    declared = read_declarations(carried[f"{ARCHIVE_FOLDER}/check.toml"])
    reference = read_csv(tmp_path / "check.csv")
    inputs = [name for name in reference.dtype.names if name not in declared["tolerances"]]
    actual = fmpy.simulate_fmu(
        str(fmu),
        start_values=declared["parameters"],
        input=reference[inputs],
        output=list(declared["tolerances"]),
        step_size=declared["step_size"],
        output_interval=declared["step_size"],
        stop_time=declared["stop_time"],
    )
    assert actual["time"].tolist() == reference["time"].tolist()
    for column, tolerance in declared["tolerances"].items():
        permitted = tolerance["absolute"] + tolerance["relative"] * np.abs(reference[column])
        error = np.abs(actual[column].astype(float) - reference[column])
        row = int(np.argmax(error - permitted))
        assert bool((error <= permitted).all()), (
            f"{column} at {reference['time'][row]} s: {error[row]} > {permitted[row]}"
        )


@pytest.mark.parametrize("name", TRUTHS)
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


def read_table(text):
    return np.genfromtxt(io.StringIO(text), delimiter=",", names=True, deletechars="", replace_space=" ")


def test_truths_import_nothing_of_the_blocks():
    script = "import sys, tests.support.checks.truths; sys.exit(any('fmus_src' in name for name in sys.modules))"
    subprocess.run([sys.executable, "-c", script], cwd=ROOT, check=True)


def test_each_block_has_a_check():
    assert {name for name, block in catalogue().items() if check_files(block)} == set(TRUTHS) == set(catalogue())


LONE = '''
from perilune import Block, Output


class Lone(Block):
    """Lone."""

    y = Output(0.0, description="y")

    def step(self, t: float, h: float) -> None:
        self.y = t + h
'''


def test_a_block_of_ones_own_takes_the_check_next_to_its_file(tmp_path):
    """Both files, in both flavours' builds to the byte; one of them alone is refused."""
    (tmp_path / "lone.py").write_text(LONE)
    (block,) = blocks_in_file(tmp_path / "lone.py")
    assert check_files(block) == {}
    guid = read_model_description(build_python_fmu(block, tmp_path / "lone.fmu"), validate=False).guid
    (tmp_path / "checks").mkdir()
    (tmp_path / "checks" / "lone.csv").write_bytes(b"time,y\n0.0,0.0\n")
    with pytest.raises(ValueError, match=r"checks/lone\.toml: no such file; a check is a trajectory, .csv, and"):
        check_files(block)
    (tmp_path / "checks" / "lone.toml").write_bytes(b"step_size = 0.125\n")
    build_python_fmu(block, tmp_path / "again.fmu")
    build_python_fmu(block, tmp_path / "lone.fmu")
    assert (tmp_path / "again.fmu").read_bytes() == (tmp_path / "lone.fmu").read_bytes()
    assert read_model_description(tmp_path / "lone.fmu", validate=False).guid == guid
    with zipfile.ZipFile(tmp_path / "lone.fmu") as archive:
        assert archive.read("extra/org.perilune/check.csv") == b"time,y\n0.0,0.0\n"
        assert archive.read("extra/org.perilune/check.toml") == b"step_size = 0.125\n"
