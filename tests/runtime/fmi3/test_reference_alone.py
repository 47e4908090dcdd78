"""Single Reference-FMUs of FMI 2.0 and 3.0. Truth: FMPy's bits at the same steps."""

import fmpy
import numpy as np
import pytest

import perilune
from tests.support.fmi3.reference import FMI2, FMI3, reference_fmu
from tests.support.fmi3.tables import columns

STEPS = {"StateSpace": 1.0, "Stair": 0.25}  # s, a whole number of internal steps


@pytest.mark.parametrize(("version", "name"), [*((2, name) for name in FMI2), *((3, name) for name in FMI3)])
def test_same_bits_as_fmpy(version, name):
    path, step = str(reference_fmu(version, name)), STEPS.get(name, 0.125)
    expected = fmpy.simulate_fmu(path, output_interval=step, stop_time=4.0)
    flight = perilune.simulate(path, step=step, stop_time=4.0)
    assert flight.status == "stop_time"
    assert np.array_equal(flight.time, expected["time"])
    compared = columns(name, expected)
    assert compared.keys() <= flight.signals.keys()
    for key, values in compared.items():
        assert np.array_equal(flight.signals[key], values), key


TIMES = [0.0, 0.5, 0.5, 1.0]  # s
DRIVEN = {
    "Float64_continuous": (np.float64, [0.0, 1.0, 3.0, 2.0]),
    "Float32_continuous": (np.float32, [0.5, 0.1, 0.1, -7.0]),
    "Int8": (np.int8, [0, 0, -128, 127]),
    "UInt32": (np.uint32, [1, 1, 4_000_000_000, 4_000_000_000]),
    "Boolean": (np.bool_, [0, 0, 1, 1]),
}


def test_same_bits_with_inputs_over_time(tmp_path):
    path, series = str(reference_fmu(3, "Feedthrough")), tmp_path / "series.csv"
    rows = list(zip(TIMES, *(values for _, values in DRIVEN.values()), strict=True))
    header = ",".join(["time", *(f"{name}_input" for name in DRIVEN)])
    series.write_text("\n".join([header, *(",".join(map(str, row)) for row in rows)]))
    kinds = [("time", np.float64), *((f"{name}_input", kind) for name, (kind, _) in DRIVEN.items())]
    expected = fmpy.simulate_fmu(path, output_interval=0.125, stop_time=1.0, input=np.array(rows, dtype=kinds))
    flight = perilune.simulate(path, step=0.125, stop_time=1.0, input=str(series))
    assert np.array_equal(flight.time, expected["time"])
    for name in DRIVEN:
        values = expected[f"{name}_output"].astype(np.float64)
        assert np.unique(values).size > 1
        assert np.array_equal(flight.signals[f"Feedthrough.{name}_output"], values), name
