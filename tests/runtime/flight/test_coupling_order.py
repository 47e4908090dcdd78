"""Convergence of a coupled simulation to the closed form as the communication step gets shorter.

Truth: x' = -x + y, y' = -y - x from (1, 0), which is exp(-t) (cos t, -sin t). Each half integrates its own equation
exactly with its input held over the step, so the error is due to the coupling alone: it is of first order with either
algorithm, since a held input is an extrapolation of order 0 (Gomes and others, Co-simulation: a survey, 2018, section
3.3).
"""

import itertools
import math

import numpy as np
import pytest

from perilune.fmus_src.export.own_blocks import build_own_blocks
from tests.support.builders import component, connection, dedented, document, fly, pack, system

BLOCK = """
    from perilune import Block, Input, Output, Parameter, State, exp


    class Half(Block):
        \"\"\"y' = -y + gain u, exact for an input that is held over the step.\"\"\"

        gain = Parameter(1.0, unit="1", description="share of the input")
        start = Parameter(1.0, unit="m", description="y at the start")
        u = Input(0.0, unit="m", description="the other half")
        y = Output(0.0, unit="m", description="this half")

        def initialize(self) -> None:
            self.y = self.start

        def step(self, t: float, h: float) -> None:
            decay = exp(-h)
            self.y = decay * self.y + (1.0 - decay) * self.gain * self.u
"""
HALVINGS = 4


@pytest.fixture(scope="module")
def half(tmp_path_factory):
    import fmpy

    folder = tmp_path_factory.mktemp("half")
    (folder / "half.py").write_text(dedented(BLOCK))
    build_own_blocks(folder / "half.py", folder, ["native"], [fmpy.platform])
    return folder / "native"


@pytest.mark.parametrize("algorithm", ["jacobi", "sequential"])
def test_the_error_halves_with_the_step(half, tmp_path, algorithm):
    halves = [component(name, "half", "input u Real m; output y Real m") for name in ("x", "y")]
    wires = connection("x.y", "y.u") + connection("y.y", "x.u")
    path = pack(tmp_path / "s.ssp", half, document(system(*halves, connections=wires)))
    errors = []
    for halving in range(HALVINGS + 1):
        step = 0.125 / 2**halving
        result = fly(path, step=step, stop_time=2.0, algorithm=algorithm, set={"y.start": 0.0, "y.gain": -1.0})
        t = result.time
        truth = np.exp(-t) * np.array([np.cos(t), -np.sin(t)])
        errors.append(np.abs(np.array([result["x.y"], result["y.y"]]) - truth).max())
    orders = [math.log2(before / after) for before, after in itertools.pairwise(errors)]
    assert np.allclose(orders, 1.0, atol=0.1), orders
    assert errors[-1] < 0.01
