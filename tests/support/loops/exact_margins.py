"""Margins of a sampled state space by python-control, with crossings that its functions omit.

Crossings are from `stability_margins` on a frequency response dense enough for its spline to be accurate to 1e-5 dB; it
omits crossings at the ends, frequency 0 and the Nyquist frequency, where L is real.
"""

from __future__ import annotations

import control
import numpy as np

from tests.support.loops.sampled_loops import response_of

POINTS = 2000
LEAST, MOST = 1e-9, 1e9  # gain margins beyond which L counts as 0 or infinite


def crossings(loop: control.StateSpace) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return gain margins as factors; phase margins (rad) and their frequencies (rad/s); all ascending in frequency."""
    frequency = np.geomspace(1e-4, 1.0, POINTS) * np.pi / loop.dt
    response = control.FRD(response_of(loop)(frequency), frequency, smooth=True)
    gain, phase, _, _, at, _ = control.stability_margins(response, returnall=True)
    gains = [value for value in (_end(loop, 1.0), *gain, _end(loop, -1.0)) if value is not None]
    retained = [value for value in gains if LEAST < value < MOST]
    return np.array(retained), np.radians((phase + 180.0) % 360.0 - 180.0), at


def disk_margin(loop: control.StateSpace, lowest: float = 1e-3) -> float:
    """Return the disk margin with skew 0, of one channel or of several at once, from ``lowest``
    of the Nyquist frequency on."""
    grid = np.geomspace(lowest, 1.0, 400) * np.pi / loop.dt
    nearest = int(np.argmin(control.disk_margins(loop, grid, skew=0.0, returnall=True)[0]))
    close = np.linspace(grid[max(nearest - 1, 0)], grid[min(nearest + 1, len(grid) - 1)], 200)
    return float(control.disk_margins(loop, close, skew=0.0)[0])


def opened(loop: control.StateSpace, channel: int) -> control.StateSpace:
    """Return one channel of two, the other one closed."""
    i, j = channel, 1 - channel
    a, b, c, d = loop.A, loop.B, loop.C, loop.D
    back = 1.0 / (1.0 + d[j, j])
    return control.ss(
        a - back * np.outer(b[:, j], c[j]),
        (b[:, i] - back * b[:, j] * d[j, i])[:, None],
        (c[i] - back * d[i, j] * c[j])[None],
        d[i, i] - back * d[i, j] * d[j, i],
        loop.dt,
    )


def _end(loop: control.StateSpace, z: float) -> float | None:
    shifted = z * np.eye(loop.nstates) - loop.A
    if np.linalg.cond(shifted) > 1.0 / np.sqrt(np.finfo(float).eps):
        return None  # an integrator
    value = (loop.C @ np.linalg.solve(shifted, loop.B) + loop.D).item()
    return -1.0 / value if value < 0.0 else None
