"""Small results of the three studies, for systems with closed-form answers, as returned to Python users."""

from __future__ import annotations

from pathlib import Path

import perilune
from tests.support.foreign.linear_system import linear_system

LIMIT = 2.5  # standard deviations of the linear system's total: Phi(-LIMIT) = 0.0062
SHARES = {"a.gain": 1.0 / 8.0, "b.gain": 4.0 / 8.0, "c.gain": 3.0 / 8.0}  # of the variance of a sum
SUM = """
system = "linear.ssp"
trials = 64
seed = 3
[draw."a.gain"]
distribution = "normal"
mean = 5
sigma = 1
[draw."b.gain"]
distribution = "normal"
mean = 0
sigma = 2
[draw."c.gain"]
distribution = "uniform"
low = 0
high = 6
[metric.total]
expression = "a.y + b.y + c.y"
reduction = "final"
unit = "m"
[metric.same]
expression = "a.tolerance"
reduction = "final"
[success]
expression = "total > 0"
"""


def rare_study(folder: Path) -> perilune.RareResult:
    """Study a failure of the linear system: its total above `LIMIT`."""
    system = linear_system(folder)
    return perilune.rare(*system, failure=f"total > {LIMIT}", samples=200, workers=1, output=folder / "rare")


def worst_study(folder: Path) -> perilune.WorstResult:
    """Search for the largest total of the linear system, in a corner of the box."""
    return perilune.worst(*linear_system(folder), metric="total", flights=300, workers=1, output=folder / "worst")


def sensitivity_study(folder: Path) -> perilune.SensitivityResult:
    """Compute indices of a sum of independent draws, which are their `SHARES` of its variance."""
    system, _ = linear_system(folder)
    (folder / "sum.toml").write_text(SUM)
    return perilune.sensitivity(system, folder / "sum.toml", 256, workers=1, output=folder / "sensitivity")
