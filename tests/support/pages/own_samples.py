"""Hand-written runs for declared figures: signals with closed-form results, and the figures."""

import math
from dataclasses import replace

import numpy as np

from perilune.analysis.documents.figures.declared import BandFigure, ErrorFigure, PulsesFigure, Signal
from perilune.analysis.runtime.ssp.conversions import Unit
from tests.support.pages.samples import run_result

DEGREE = math.pi / 180.0
RADIAN = Unit("rad", (0, 0, 0, 0, 0, 0, 0, 1))
DEG = Unit("deg", (0, 0, 0, 0, 0, 0, 0, 1), DEGREE)
SECOND = Unit("s", (0, 0, 1, 0, 0, 0, 0, 0))
ROWS = 401
TIME = 0.5 * np.arange(ROWS)


def scalar(name, unit=None, factor=1.0):
    return Signal(name, (name,), unit, factor, (0.0,))


def vector(name, size, unit=None, factor=1.0, offsets=None):
    names = tuple(f"{name}[{index}]" for index in range(1, size + 1))
    return Signal(name, names, unit, factor, offsets or (0.0,) * size)


def flown(**signals):
    """Return a run with signals of a `ship`; vectors are lists of elements. Row n is at n / 2 s."""
    collected = {}
    for name, values in signals.items():
        rows = np.atleast_2d(np.asarray(values, dtype=float))
        for index, row in enumerate(rows, 1):
            collected[f"ship.{name}" if len(rows) == 1 else f"ship.{name}[{index}]"] = row
    rows = len(next(iter(collected.values())))
    return replace(
        run_result(),
        time=TIME[:rows],
        signals=collected,
        units=dict.fromkeys(collected),
        types=dict.fromkeys(collected, "Real"),
    )


ANGLES = BandFigure(
    title="Angles",
    notes=(),
    signal=vector("ship.angles", 2, DEG, 1.0 / DEGREE),
    low=-0.5,
    high=0.5,
    name="settled",
    about=(),
    labels=("roll", "yaw"),
)
PULSES = PulsesFigure(
    title="Jets",
    notes=(),
    lengths=vector("ship.lengths", 2, SECOND),
    count=scalar("ship.count"),
    remainder=vector("ship.rest", 2, SECOND),
    total=scalar("ship.spent", SECOND),
    labels=("x", "y"),
)
ERROR = ErrorFigure(
    title="Error",
    notes=(),
    estimate=scalar("ship.estimate", RADIAN),
    truth=scalar("ship.truth", RADIAN),
    sigma=scalar("ship.sigma", RADIAN),
    after=50.0,
    labels=("",),
)


def angles():
    """Return angles: roll is inside at once, leaves at 30 s and returns at 40.5 s; yaw falls
    from 20 deg to 0.5 deg at 97.5 s."""
    roll = np.where((TIME >= 30.0) & (TIME < 40.5), 0.7, 0.1)
    return np.stack([roll, np.maximum(0.0, 20.0 - TIME * 0.2)]) * DEGREE


def pulses():
    """Return a set of lengths every 5 rows, held between; x both ways, y one way; and the last
    row's, which never act."""
    tick = np.arange(ROWS) // 5
    x = np.where(tick % 10 == 3, 0.05, np.where(tick % 10 == 7, -0.15, 0.0))
    y = np.where(tick < 4, 0.2, 0.0)
    y[-1] = 0.2
    spent = np.cumsum(np.concatenate([[0.0], ((np.abs(x) + np.abs(y)) * (np.arange(ROWS) % 5 == 0))[:-1]]))
    return {"lengths": [x, y], "count": tick + 1, "rest": [0.01 * np.sin(TIME), 0.0 * TIME], "spent": spent}


def errors():
    """Return from 50 s on an error of 0.3, 1.5, 2.5, 3.5 sigma in turn; sigma is 0 before 10 s."""
    sigma = np.where(TIME < 10.0, 0.0, 0.1 * DEGREE)
    fraction = np.array([0.3, -1.5, 2.5, -3.5])[np.arange(ROWS) % 4]
    return {"truth": 1.0 + 0.0 * TIME, "estimate": 1.0 + np.where(TIME < 50.0, 0.2, fraction * sigma), "sigma": sigma}
