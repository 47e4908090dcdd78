"""`perilune verify` on Reference-FMUs of FMI 2.0 and 3.0, with the manifest in their repository.

Truth: FMPy's simulation of the default experiment.
"""

import re
import zipfile

import fmpy
import pytest

from perilune.analysis.cli import main
from perilune.fmus_src.evidence.manifest import FOLDER, MANIFEST
from tests.evidence.test_verify import OTHERS, changed
from tests.support.builders import write_zip
from tests.support.fmi3.reference import FMI2, FMI3, reference_fmu
from tests.support.fmi3.tables import columns

FMUS = [*((2, name) for name in FMI2), *((3, name) for name in FMI3)]
STOP = 2.0  # s, of all of them a whole number of default steps
STEPPED = {"StateSpace": 10.0}  # s, of those with steps too long for ten samples in that time


def with_result(version, name, path, change=lambda table: table):
    """Return the FMU with FMPy's trajectory; those of texts and of arrays are left out."""
    fmu = reference_fmu(version, name)
    simulated = fmpy.simulate_fmu(str(fmu), stop_time=STEPPED.get(name, STOP))
    numbers = {
        "time": simulated["time"],
        **{key.removeprefix("fmu."): samples for key, samples in columns("fmu", simulated).items()},
    }
    rows = (",".join(repr(samples[row].item()) for samples in numbers.values()) for row in range(simulated.size))
    table = "\n".join([",".join(numbers), *rows, ""])
    with zipfile.ZipFile(fmu) as archive:
        files = {entry: archive.read(entry) for entry in archive.namelist()}
    return write_zip(path, files | {MANIFEST: OTHERS, f"{FOLDER}/out.csv": change(table.encode())})


@pytest.mark.parametrize(("version", "name"), FMUS)
def test_reproduced(version, name, tmp_path, capsys):
    path = with_result(version, name, tmp_path / "x.fmu")
    assert main(["verify", str(path)]) == 0
    out = capsys.readouterr().out
    assert "no attribute fmi-ls-description" in " ".join(out.split())
    assert re.search(
        r"default experiment: out.csv: \d+ samples of \d+ signals: the same bits; tolerance up to 1e-6 of", out
    )


def test_a_difference_is_named(tmp_path, capsys):
    path = with_result(3, "Dahlquist", tmp_path / "x.fmu", lambda table: changed(table, "x", 7, lambda x: x * 1.001))
    assert main(["verify", str(path)]) == 1
    assert re.search(r"x differs by 0\.000478 at t = 0\.7 s: reference 0\.478", capsys.readouterr().err)
