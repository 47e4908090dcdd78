"""Chains of ten different FMUs with ten connections each, of a hundred components under `make long`.

Truth: the recursion of the chain, in numpy. `benchmarks/README.md` describes the growth of time and memory.
"""

import numpy as np
import pytest

from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from tests.support.large_systems import KINDS, build_mixers, large_system
from tests.support.lengths import either

COUNT, STEPS = either(200, 60), 4


@pytest.fixture(scope="module")
def mixers(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mixers")
    build_mixers(folder)
    return folder / "native"


@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_a_ring_computes_its_recursion(mixers, tmp_path, algorithm):
    system = large_system(tmp_path / "large", mixers, COUNT)
    options = SystemOptions(step=0.1, stop_time=0.1 * STEPS, algorithm=algorithm)
    with Simulation(prepare_system(system, options)) as simulation:
        result = simulation.fly()
    kinds = np.arange(COUNT) % KINDS
    direct, fractions = kinds % 2 == 1, 0.05 + 0.01 * kinds
    now = np.zeros(COUNT)
    if algorithm == "jacobi":  # all at once, with outputs of the point before; the start is settled in order
        for n in [n for n in range(COUNT) if not direct[n]] + [n for n in range(COUNT) if direct[n]]:
            now[n] = kinds[n] + fractions[n] * (now[n - 1] if direct[n] else 0.0)
    expected = []
    for step in range(STEPS + 1):
        before = now.copy()
        if step or algorithm == "sequential":
            for n in range(COUNT):
                if not direct[n]:
                    now[n] = kinds[n] + fractions[n] * (before[n - 1] if step else 0.0)
            for n in range(COUNT):
                if direct[n]:
                    now[n] = kinds[n] + fractions[n] * (before if algorithm == "jacobi" else now)[n - 1]
        expected.append(now.copy())
    for n in (0, 1, 2, COUNT - 2, COUNT - 1):
        np.testing.assert_allclose(result[f"c{n}.y"][:, 3], np.array(expected)[:, n], rtol=1e-14)
