"""Loop opened at its break point, as a state space with the loop's sample period, from the lifted closed loop.

The lifted model maps the memory over a hyperperiod of M samples of the loop. If the loop does not change from sample to
sample, one state space describes its outputs at every sample, x[k+1] = A x[k] + B u[k]: B is the lifted input matrix of
the last sample, C the lifted output matrix of the first, and A shifts the observability matrix by one sample, O A = O',
which is solved by least squares in the coordinates of the memory. It is compared with the lifted model before it is
used.

Source: Kung 1978, A new identification and model reduction algorithm via singular value decomposition (shift of the
observability matrix); Bittanti and Colaneri 2009, Periodic Systems, section 6.2 (lifted reformulation).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..results.responses import StateSpace
from .lifted import LiftedModel, SampledChannel

LOWEST, HIGHEST, COUNT = 1e-3, 0.97, 60  # frequencies, over the Nyquist frequency, at which L is compared
SMALLEST_GAIN = 0.03  # least |L|, and its inverse the largest: margins are determined where L is about 1
SAME = 1e-3  # relative difference of L up to which one state space stands for all samples
NEGLIGIBLE = 1e-11  # relative size of singular values that carry no information on A


def open_loop(model: LiftedModel, ports: tuple[SampledChannel, ...]) -> StateSpace:
    """Return L of some ports with one sample period, their cuts open and other loops closed.

    ``model`` is reduced for these ports. The result has the ports' sample period if they do not change from sample to
    sample, else it is lifted over the hyperperiod.
    """
    lifted = _open(model, ports)
    if lifted.samples > 1:
        single = _at_every_sample(lifted, model, ports)
        if single.error <= SAME:
            return single
    return lifted


def _open(model: LiftedModel, ports: tuple[SampledChannel, ...]) -> StateSpace:
    """Return the lifted model with the cuts open, samples stacked oldest first, in the memory's units."""
    samples = ports[0].count
    rows = np.ravel([[port.first + sample for port in ports] for sample in range(samples)])
    inside = np.linalg.inv(model.du[np.ix_(rows, rows)])
    scale = np.array([model.variables[name].scale for name in model.names])
    c = -(model.cv[rows] - model.dv[np.ix_(rows, rows)] @ inside @ model.cu[rows])
    names = [port.channel.name for port in ports]
    marks = [f" at sample {sample + 1}" if samples > 1 else "" for sample in range(samples)]
    opened = StateSpace(
        a=(model.a - model.b[:, rows] @ inside @ model.cu[rows]) * scale[:, None] / scale,
        b=model.b[:, rows] @ inside * scale[:, None],
        c=c / scale,
        d=-model.dv[np.ix_(rows, rows)] @ inside,
        period=model.period,
        samples=samples,
        states=model.names,
        state_units=tuple(model.variables[name].unit for name in model.names),
        inputs=tuple(f"{name} in{mark}" for mark in marks for name in names),
        outputs=tuple(f"{name} returned, negative{mark}" for mark in marks for name in names),
        signal_units=tuple(port.channel.unit for port in ports) * samples,
        error=0.0,
    )
    frequency = np.geomspace(LOWEST, HIGHEST, COUNT) * np.pi / ports[0].seconds
    return replace(opened, error=_difference(_waves(opened, ports, frequency), model.response(ports, frequency)))


def _at_every_sample(lifted: StateSpace, model: LiftedModel, ports: tuple[SampledChannel, ...]) -> StateSpace:
    """Return the best state space for all samples; its ``error`` shows whether one exists."""
    count, states = len(ports), len(lifted.a)
    blocks = [lifted.c]
    for _ in range(1 + -(-states // len(lifted.c))):
        blocks.append(blocks[-1] @ lifted.a)
    rows = np.vstack(blocks)
    size = np.max(abs(rows), axis=0, initial=0.0)
    size[size == 0.0] = 1.0  # states in units of their largest effect on the outputs
    scaled = rows / size
    a = np.linalg.lstsq(scaled[:-count], scaled[count:], rcond=NEGLIGIBLE)[0]
    period = ports[0].seconds
    single = replace(
        lifted,
        a=a / size[:, None] * size,
        b=lifted.b[:, -count:],
        c=lifted.c[:count],
        d=lifted.d[:count, :count],
        period=period,
        samples=1,
        inputs=tuple(f"{port.channel.name} in" for port in ports),
        outputs=tuple(f"{port.channel.name} returned, negative" for port in ports),
        signal_units=tuple(port.channel.unit for port in ports),
    )
    frequency = np.geomspace(LOWEST, HIGHEST, COUNT) * np.pi / period
    return replace(single, error=_difference(single.response(frequency), model.response(ports, frequency)))


def _waves(lifted: StateSpace, ports: tuple[SampledChannel, ...], frequency: np.ndarray) -> np.ndarray:
    """Return L of a lifted open loop (n, m, m): the mean of the responses at the frequency of exp(jwt)."""
    count = len(ports)
    wave = np.exp(1j * ports[0].seconds * np.outer(frequency, np.arange(lifted.samples)))
    blocks = lifted.response(frequency).reshape(-1, lifted.samples, count, lifted.samples, count)
    return np.einsum("fs,fsitj,ft->fij", wave.conj(), blocks, wave) / lifted.samples


def _difference(actual: np.ndarray, expected: np.ndarray) -> float:
    size = np.linalg.norm(expected, axis=(1, 2))
    significant = (size > SMALLEST_GAIN) & (size < 1.0 / SMALLEST_GAIN)
    change = np.linalg.norm(actual - expected, axis=(1, 2))[significant] / size[significant]
    return float(np.max(np.where(np.isfinite(change), change, 1.0), initial=0.0))
