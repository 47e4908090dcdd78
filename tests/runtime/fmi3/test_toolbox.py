"""Container by the FMU Manipulation Toolbox as an FMU of FMI 3.0, with all types and arrays. Truth: FMPy's bits."""

import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest

import perilune
from tests.support.builders import retouched
from tests.support.fmi3.reference import reference_fmu
from tests.support.fmi3.strict_fmu import strict_fmu
from tests.support.fmi3.tables import columns

RULES = """rule;from_fmu;from_port;to_fmu;to_port
FMU;VanDerPol.fmu;;;
FMU;Feedthrough.fmu;;;
FMU;fixed.fmu;;;
LINK;VanDerPol.fmu;x0;Feedthrough.fmu;Float64_continuous_input
"""


@pytest.fixture(scope="module")
def container(tmp_path_factory):
    """Build a container; the toolbox takes arrays of fixed sizes only."""
    folder = tmp_path_factory.mktemp("container")
    for name in ("VanDerPol", "Feedthrough"):
        shutil.copy(reference_fmu(3, name), folder)
    sizes = ('<Dimension valueReference="1"/>', '<Dimension start="2"/>')
    retouched(strict_fmu(folder), folder / "fixed.fmu", lambda text: text.replace(*sizes))
    (folder / "box.csv").write_text(RULES)
    tool = Path(sys.executable).with_name("fmucontainer")
    options = ["-container", "box.csv:0.125", "-fmi", "3", "-fmu-directory", "."]
    subprocess.run([tool, *options], cwd=folder, check=True, capture_output=True)
    return str(folder / "box.fmu")


def test_same_bits_as_fmpy(container):
    expected = fmpy.simulate_fmu(container, output_interval=0.125, stop_time=2.0, validate=False)
    flight = perilune.simulate(container, step=0.125, stop_time=2.0)
    compared = columns("box", expected)
    assert len(compared) > 20
    for key, numbers in compared.items():
        assert np.array_equal(flight.signals[key], numbers), key


def test_starts_that_it_declares_in_its_own_way(container):
    """As elements, which the schema allows of texts only: a note says so, and they count."""
    (check,) = perilune.validate(container).checks
    assert any("Element 'Start'" in note for note in check.notes)
    values = perilune.simulate(container, set={"box.u[1]": 4.0}, step=0.125, stop_time=1.0, record=["u"])
    assert values["box.u"][-1].tolist() == [4.0, 0.25]
