"""Frequency responses of the lifted model. Truth: dense solves; for a closed loop, its open loop."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from perilune.analysis.stability.point.lifted import LiftedModel, SampledChannel
from tests.support.loops.sampled_loops import HeldDoubleIntegrator, response_of


def port(seconds: float, first: int, count: int) -> SampledChannel:
    return SampledChannel(SimpleNamespace(), seconds, first, count)  # the channel itself is not looked at


@pytest.mark.parametrize("states", [0, 1, 7, 60])
def test_equals_dense_solves(states: int) -> None:
    """Channels of four, two and one sample a period, at more frequencies than are taken together."""
    random = np.random.default_rng(states)
    ports, rows = (port(0.1, 0, 4), port(0.2, 4, 2), port(0.4, 6, 1)), 7
    a = random.normal(size=(states, states)) / np.sqrt(states + 1.0)
    b, cu, cv = (random.normal(size=shape) for shape in ((states, rows), (rows, states), (rows, states)))
    du, dv = np.eye(rows) + 0.1 * random.normal(size=(rows, rows)), random.normal(size=(rows, rows))
    model = LiftedModel(a, b, cu, du, cv, dv, (), 0.4, ports)
    frequency = np.geomspace(1e-2, np.pi / 0.4, 150)
    for chosen in (ports, ports[:1], (ports[2], ports[0])):
        u, v = model.disturbance_response(chosen, frequency)
        for index, w in enumerate(frequency):
            wave = np.zeros((rows, len(chosen)), dtype=complex)
            mean = np.zeros((len(chosen), rows), dtype=complex)
            for column, one in enumerate(chosen):
                wave[one.rows, column] = np.exp(1j * w * one.seconds * np.arange(one.count))
                mean[column, one.rows] = wave[one.rows, column].conj() / one.count
            x = np.linalg.solve(np.exp(0.4j * w) * np.eye(states) - a, b @ wave)
            expected_u, expected_v = mean @ (cu @ x + du @ wave), mean @ (cv @ x + dv @ wave)
            scale = max(1.0, float(np.max(np.abs(x), initial=0.0)))
            np.testing.assert_allclose(u[index], expected_u, rtol=1e-12, atol=1e-12 * scale)
            np.testing.assert_allclose(v[index], expected_v, rtol=1e-12, atol=1e-12 * scale)
        expected = -np.linalg.solve(u.swapaxes(1, 2), v.swapaxes(1, 2)).swapaxes(1, 2)
        np.testing.assert_allclose(model.response(chosen, frequency), expected, rtol=1e-12)


def test_a_closed_loop_gives_back_its_open_loop() -> None:
    """d goes in before the plant, which returns -y: u = d + v."""
    system = HeldDoubleIntegrator(period=0.25, samples=2, phase_crossover=0.4, gain_crossover=0.2).system
    a, b, c = system.A, system.B, system.C
    model = LiftedModel(a - b @ c, b, -c, np.eye(1), -c, np.zeros((1, 1)), (), 0.25, (port(0.25, 0, 1),))
    frequency = np.geomspace(0.1, np.pi / 0.25, 200)
    actual = model.response(model.ports, frequency)[:, 0, 0]
    np.testing.assert_allclose(actual, response_of(system)(frequency), rtol=1e-9, atol=1e-13)
