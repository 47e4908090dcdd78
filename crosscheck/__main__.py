"""Simulates all cases in both codes and compares them: the tables and the figure of docs/concepts/crosscheck.md.

    python -m crosscheck PYTHON [CASE ...]

PYTHON is the interpreter of the environment that has Basilisk. Exit status 1 where a difference exceeds its bound.
"""

import subprocess
import sys
import tempfile
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path

import numpy as np

from crosscheck.case import Case
from crosscheck.figure import draw_differences
from crosscheck.table import Table, differences, read_table

ROOT = Path(__file__).parents[1]
FIGURE = ROOT / "docs" / "images" / "crosscheck" / "differences.svg"
CASES = (
    "moon_thrust",
    "moon_coast",
    "robot_jets",
    "gravity_gradient",
    "free_rotation",
    "guided_descent",
    "robot_gyros",
    "capsule_entry",
    "wheel_satellite",
)
HEADS = (
    *("case", "step, s", "position, m", "velocity, m/s", "attitude, rad", "rate, rad/s", "mass, kg"),
    *("wheel speed, rad/s", "order"),
)
QUANTITIES = ("position", "velocity", "attitude", "rate", "mass", "wheel speed")
ROUNDING = 0.5  # an order below is one of rounding: half the step does not bring both nearer


def main(python: str, names: tuple[str, ...]) -> int:
    """Print the table; the number of cases that differ by more than their bounds."""
    print(f"| {' | '.join(HEADS)} |\n|{' --- |' * len(HEADS)}")
    flown: dict[str, list[dict[str, np.ndarray]]] = {}
    beyond = []
    for name in names:
        case: Case = import_module(f"crosscheck.cases.{name}.case").CASE
        flown[name] = [apart(name, case, step, python) for step in (case.step, 0.5 * case.step)]
        coarse, fine = ({each: float(column.max()) for each, column in rows.items()} for rows in flown[name])
        print(f"| {' | '.join(row_of(case, coarse, fine))} |")
        beyond += [f"{name}: {each} {coarse[each]:.3g}" for each, bound in case.bounds.items() if coarse[each] > bound]
    print("", *statements(names), sep="\n")
    if names == CASES:
        draw_differences({name: import_module(f"crosscheck.cases.{name}.case").CASE for name in names}, flown, FIGURE)
    for line in beyond:
        print(f"beyond its bound: {line}", file=sys.stderr)
    return len(beyond)


def statements(names: Iterable[str]) -> list[str]:
    """The rows of the page's second table: what each case states of itself."""
    rows = ["| case | verifies | gravitation | environment | integrator | matched how |", f"|{' --- |' * 6}"]
    for name in names:
        case: Case = import_module(f"crosscheck.cases.{name}.case").CASE
        stated = (case.title, case.verifies, case.gravitation, case.environment, case.integrator, case.matched)
        rows.append(f"| {' | '.join(stated)} |")
    return rows


def apart(name: str, case: Case, step: float, python: str) -> dict[str, np.ndarray]:
    """How far both codes are apart with a step (s), over time."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "basilisk.csv"
        command = [python, "-W", "ignore", "-m", "crosscheck.basilisk_side", name, repr(step), str(file)]
        subprocess.run(command, cwd=ROOT, check=True)
        ours: Table = import_module(f"crosscheck.cases.{name}.ours").simulate(step)
        return differences(case, ours, read_table(file))


def row_of(case: Case, coarse: dict[str, float], fine: dict[str, float]) -> list[str]:
    """The row of a case: the largest differences with its step, and how they fall with half of it."""
    orders = [np.log2(coarse[each] / fine[each]) for each in case.quantities if coarse[each] > 0.0 < fine[each]]
    order = float(np.median(orders))
    numbers = [f"{coarse[each]:.1e}" if each in coarse else "" for each in QUANTITIES]
    return [case.title, f"{case.step:g}", *numbers, f"{order:.1f}" if order > ROUNDING else "rounding"]


if __name__ == "__main__":
    interpreter, *chosen = sys.argv[1:]
    sys.exit(1 if main(interpreter, tuple(chosen) or CASES) else 0)
