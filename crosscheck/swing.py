"""Flights with modes, of linear form here: their differences fall with the square of the amplitude."""

from dataclasses import dataclass

import numpy as np

from crosscheck.table import Table, at_common_times

HEADS = (
    *("case", "largest rate, rad/s", "rate, rad/s", "rate with a tenth of the torque, rad/s", "fall"),
    *("displacement, relative", "with a tenth of the torque"),
)
TENTH = 0.1


@dataclass(frozen=True)
class Swing:
    """A flight of which both codes have the modes, with a torque and with a tenth of it.

    ``displacements`` are the columns of the modes; ``fall`` is how often at least the difference of the angular
    velocity (rad/s) with the whole torque is that with a tenth of it: 100 if it is quadratic. ``bound`` is the largest
    difference with the whole torque, over the largest angular velocity, that counts as agreement.
    """

    title: str
    verifies: str
    matched: str
    step: float
    duration: float
    displacements: tuple[str, ...]
    fall: float
    bound: float


def swing_differences(case: Swing, ours: Table, other: Table) -> tuple[float, float, float]:
    """Return the largest angular velocity, its largest difference (rad/s), that of displacements over the largest."""
    first, second = at_common_times(ours, other)

    def rows(table: Table, names: tuple[str, ...]) -> np.ndarray:
        return np.stack([table[name] for name in names])

    rate = ("rate[1]", "rate[2]", "rate[3]")
    largest = float(np.linalg.norm(rows(second, rate), axis=0).max())
    apart = float(np.linalg.norm(rows(first, rate) - rows(second, rate), axis=0).max())
    bent = np.abs(rows(second, case.displacements)).max()
    return (
        largest,
        apart,
        float(np.abs(rows(first, case.displacements) - rows(second, case.displacements)).max() / bent),
    )


def swing_row(case: Swing, whole: tuple[float, float, float], tenth: tuple[float, float, float]) -> list[str]:
    """Return the row of the table."""
    numbers = (whole[0], whole[1], tenth[1])
    return [
        case.title,
        *(f"{number:.1e}" for number in numbers),
        f"{whole[1] / tenth[1]:.0f}",
        f"{whole[2]:.1e}",
        f"{tenth[2]:.1e}",
    ]
