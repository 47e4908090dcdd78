"""Linear model of a periodic system over one hyperperiod, and the loops' frequency responses.

A loop that passes its cut M times in a hyperperiod has M inputs and M outputs there. Driven with the samples of
exp(jwt), a channel responds at w and, if the system is truly periodic, at frequencies that differ by multiples of 2
pi/hyperperiod. Its loop gain at w is the negated ratio of the return signal at w to the input at w, both with the loop
closed, as in a measurement by injection. If the system does not change from sample to sample, the loop gain is the
transfer function.

Source: Bittanti and Colaneri 2009, Periodic Systems, sections 2.2 (lifting) and 2.3 (exponentially modulated periodic
responses).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import scipy.linalg

from ..request.channels import Channel

RANK = 1e-6  # fraction of the largest singular value, below which a direction vanishes within a period
SHARE = 1e-7
LOWEST, LOOKS = (
    1e-4,
    24,
)  # number of frequencies for shares, and the lowest over the Nyquist frequency
QUIET = 1e-6  # response below which no cell has a share
UNIT_CIRCLE = 1e-5  # distance from the unit circle up to which a pole counts as on it
_BLOCK = 8  # rows of a triangle that are solved one by one before the others are updated at once
_TOGETHER = 64  # frequencies at a time: arrays fit into the cache, and products are too small for threads of BLAS


@dataclass(frozen=True)
class SampledChannel:
    """Rows and columns of one channel in the model, in order of its samples."""

    channel: Channel
    seconds: float  # s, between samples
    first: int
    count: int

    @property
    def rows(self) -> slice:
        return slice(self.first, self.first + self.count)


@dataclass(frozen=True)
class StateVariable:
    """Memory cell of a state of the model; one unit of the state is ``scale`` times ``unit`` (None: dimensionless)."""

    scale: float
    unit: str | None


@dataclass
class LiftedModel:
    """Closed loop over one hyperperiod: x' = a x + b d, u = cu x + du d, v = cv x + dv d.

    d is the excitation at the cuts, u the signal after them, v the return signal; all are stacked over the channels'
    samples. ``names`` are the memory cells of x, in units that balance a; ``variables`` describes them by name.
    ``period`` is in s.
    """

    a: np.ndarray
    b: np.ndarray
    cu: np.ndarray
    du: np.ndarray
    cv: np.ndarray
    dv: np.ndarray
    names: tuple[str, ...]
    period: float
    ports: tuple[SampledChannel, ...]
    variables: Mapping[str, StateVariable] = field(default_factory=dict)

    def reduce(self, ports: tuple[SampledChannel, ...]) -> LiftedModel:
        """Return the model of the memory that both affects the ports and is affected by them, directly or not.

        Cells whose share of the return signal is below SHARE at all frequencies are omitted: only rounding connects
        them, as for the covariance of a filter whose innovations vanish.
        """
        rows = np.concatenate([np.arange(port.first, port.first + port.count) for port in ports])
        moved = reachable(self.a != 0.0, np.any(self.b[:, rows] != 0.0, axis=1))
        heard = np.any(self.cu[rows] != 0.0, axis=0) | np.any(self.cv[rows] != 0.0, axis=0)
        moves = reachable(self.a.T != 0.0, heard)
        connected = self._part(np.flatnonzero(moved & moves))
        if not connected.a.size:
            return connected
        fraction = np.max([connected._shares(port) for port in ports], axis=0)
        return connected._part(np.flatnonzero(fraction > SHARE))

    def _part(self, kept: np.ndarray) -> LiftedModel:
        return replace(
            self,
            a=self.a[np.ix_(kept, kept)],
            b=self.b[kept],
            cu=self.cu[:, kept],
            cv=self.cv[:, kept],
            names=tuple(self.names[place] for place in kept),
        )

    def _shares(self, port: SampledChannel) -> np.ndarray:
        """Return the largest relative change of the return signal over frequency, per relative change of each cell."""
        fractions = np.zeros(len(self.a))
        identity = np.eye(len(self.a))
        for w in np.geomspace(LOWEST, 1.0, LOOKS) * np.pi / port.seconds:
            wave = np.exp(1j * w * port.seconds * np.arange(port.count))
            shifted = np.exp(1j * w * self.period) * identity - self.a
            moved = np.linalg.solve(shifted, self.b[:, port.rows] @ wave)
            heard = wave.conj() @ self.cv[port.rows]
            moves = np.linalg.solve(shifted.T, heard)
            whole = abs(heard @ moved + wave.conj() @ (self.dv[port.rows, port.rows] @ wave))
            fractions = np.maximum(fractions, abs(moved * moves) / max(whole, QUIET))
        return fractions

    @cached_property
    def lasting(self) -> LiftedModel:
        """The same model without the directions that vanish within some periods (poles at z = 0).

        Memory is restricted to the range of a, then to the range of a within it, and so on, in orthogonal bases, until
        no direction is lost. A direction that vanishes still transfers d to u and v within the period and over the
        periods that it takes to vanish, so the result is for poles only.
        """
        if not self.a.size:
            return self
        a, b, cu, cv = self.a, self.b, self.cu, self.cv
        while a.shape[0]:
            left, sizes, _ = np.linalg.svd(a)
            rank = int(np.sum(sizes > RANK * max(1.0, sizes[0])))
            if rank == a.shape[0]:
                break
            basis = left[:, :rank]
            a, b, cu, cv = basis.T @ a @ basis, basis.T @ b, cu @ basis, cv @ basis
        return replace(self, a=a, b=b, cu=cu, cv=cv, names=(), variables={})

    def poles(self) -> np.ndarray:
        """Return closed-loop multipliers over the hyperperiod, without multipliers at 0, largest first."""
        values = np.linalg.eigvals(self.lasting.a)
        return values[np.argsort(-abs(values), kind="stable")]

    def unstable(self) -> int:
        """Count closed-loop multipliers outside the unit circle."""
        return int(np.sum(abs(self.poles()) > 1.0 + UNIT_CIRCLE))

    def open_loops(self, ports: tuple[SampledChannel, ...]) -> np.ndarray:
        """Return nonzero multipliers with the cuts of these ports open and the other loops closed."""
        rows = np.concatenate([np.arange(port.first, port.first + port.count) for port in ports])
        inside = np.linalg.solve(self.du[np.ix_(rows, rows)], self.cu[rows])
        a = self.a - self.b[:, rows] @ inside
        return replace(self, a=a, names=(), variables={}).poles()

    def disturbance_response(
        self, ports: tuple[SampledChannel, ...], frequency: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the responses of u and v to d at each frequency, both (n, m, m) for m ports."""
        u = np.empty((frequency.size, len(ports), len(ports)), dtype=complex)
        v = np.empty_like(u)
        _, b, cu, cv = self._triangular
        for first in range(0, frequency.size, _TOGETHER):
            chosen = slice(first, first + _TOGETHER)
            w = frequency[chosen]
            # the samples of exp(jwt) at each port, (samples, frequencies)
            waves = [np.exp(1j * np.outer(port.seconds * np.arange(port.count), w)) for port in ports]
            for column, (source, drive) in enumerate(zip(ports, waves, strict=True)):
                x = self._resolvent(np.exp(1j * self.period * w), b[:, source.rows] @ drive)
                for row, (port, wave) in enumerate(zip(ports, waves, strict=True)):
                    c = np.vstack([cu[port.rows], cv[port.rows]])
                    d = np.vstack([self.du[port.rows, source.rows], self.dv[port.rows, source.rows]])
                    samples = np.reshape(c @ x + d @ drive, (2, port.count, -1))
                    u[chosen, row, column], v[chosen, row, column] = np.mean(samples * wave.conj(), axis=1)
        return u, v

    @cached_property
    def _triangular(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Complex Schur form of a, with b, cu and cv in its basis."""
        triangle, unitary = scipy.linalg.schur(self.a, output="complex")
        return triangle, unitary.conj().T @ self.b, self.cu @ unitary, self.cv @ unitary

    def _resolvent(self, z: np.ndarray, right: np.ndarray) -> np.ndarray:
        """Return (z - triangle)^-1 right, (states, n) with a column for each z, by simultaneous substitution."""
        triangle = self._triangular[0]
        shifted = z - triangle.diagonal()[:, None]
        x = np.array(right, dtype=complex)
        for end in range(len(x), 0, -_BLOCK):
            start = max(0, end - _BLOCK)
            for row in range(end - 1, start - 1, -1):
                x[row] = (x[row] + triangle[row, row + 1 : end] @ x[row + 1 : end]) / shifted[row]
            x[:start] += triangle[:start, start:end] @ x[start:end]
        return x

    def response(self, ports: tuple[SampledChannel, ...], frequency: np.ndarray) -> np.ndarray:
        """Return L, the negated transfer function from input to return signal, (n, m, m), with other loops closed."""
        u, v = self.disturbance_response(ports, np.asarray(frequency, dtype=float))
        return -np.linalg.solve(np.swapaxes(u, 1, 2), np.swapaxes(v, 1, 2)).swapaxes(1, 2)

    def periodicity(self, port: SampledChannel, frequency: np.ndarray) -> float:
        """Return the largest share of the input at frequencies other than the excited one; 0 if time-invariant."""
        worst = 0.0
        for w in frequency:
            wave = np.exp(1j * w * port.seconds * np.arange(port.count))
            x = np.linalg.solve(
                np.exp(1j * w * self.period) * np.eye(len(self.a)) - self.a, self.b[:, port.rows] @ wave
            )
            samples = (self.cu[port.rows] @ x + self.du[port.rows, port.rows] @ wave) * wave.conj()
            worst = max(worst, float(np.std(samples) / abs(np.mean(samples))))
        return worst


def reachable(arrows: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Return the mask of cells that can be reached from ``start`` along ``arrows`` [to, from]."""
    reached = start.copy()
    while True:
        grown = reached | (arrows @ reached)
        if np.array_equal(grown, reached):
            return reached
        reached = grown
