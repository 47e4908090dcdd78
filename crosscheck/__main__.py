"""Simulates all cases in both codes and compares them: the tables and figures of docs/concepts/crosscheck.md.

    python -m crosscheck PYTHON [CASE ...]

PYTHON is the interpreter of the environment that has Basilisk. Exit status 1 where a difference exceeds its bound.
"""

import sys
from collections.abc import Iterable
from importlib import import_module
from typing import Any

import numpy as np

from crosscheck import comparison, swing
from crosscheck.both import ROOT, tables
from crosscheck.case import Case
from crosscheck.comparison import Comparison, comparison_row, relative_differences
from crosscheck.figure import draw_differences
from crosscheck.swing import TENTH, Swing, swing_differences, swing_row
from crosscheck.table import differences

FOLDER = ROOT / "docs" / "images" / "crosscheck"
FIGURES = {  # cases by the figure that has them
    "differences.svg": (
        *("moon_thrust", "moon_coast", "robot_jets", "gravity_gradient", "free_rotation", "guided_descent"),
        *("robot_gyros", "capsule_entry", "wheel_satellite"),
    ),
    "low_orbit.svg": ("leo_zonal", "leo_tesseral", "leo_gradient", "leo_torquers", "leo_plates"),
}
CASES = tuple(name for names in FIGURES.values() for name in names)
MODELS = (
    *("harmonics", "magnetic_field", "centred_dipole", "eclipse", "surfaces", "sphere"),
    *("magnetometer", "sun_heads", "gyros", "nadir"),
)
SWINGS = ("slosh", "panels")
HEADS = (
    *("case", "step, s", "position, m", "velocity, m/s", "attitude, rad", "rate, rad/s", "mass, kg"),
    *("wheel speed, rad/s", "order"),
)
QUANTITIES = ("position", "velocity", "attitude", "rate", "mass", "wheel speed")
ROUNDING = 0.5  # an order below is one of rounding: half the step does not bring both nearer


def main(python: str, names: tuple[str, ...]) -> int:
    """Print the tables; the number of differences that are beyond their bounds."""
    beyond = []
    for compare, known in ((compare_flights, CASES), (compare_models, MODELS), (compare_swings, SWINGS)):
        chosen = tuple(name for name in known if name in names)
        if chosen:
            beyond += compare(python, chosen)
            print()
    if flights := tuple(name for name in CASES if name in names):
        print(*statements(flights), sep="\n")
    for line in beyond:
        print(f"beyond its bound: {line}", file=sys.stderr)
    return len(beyond)


def compare_flights(python: str, names: tuple[str, ...]) -> list[str]:
    """Print the table of flights; what is beyond its bound. Draw each figure all of whose flights are among them."""
    print_row(HEADS, begins=True)
    flown: dict[str, list[dict[str, np.ndarray]]] = {}
    beyond = []
    for name in names:
        case: Case = stated("cases", name)
        flown[name] = [differences(case, *tables("cases", name, python, s)) for s in (case.step, 0.5 * case.step)]
        coarse, fine = ({each: float(column.max()) for each, column in rows.items()} for rows in flown[name])
        print_row(row_of(case, coarse, fine))
        beyond += [f"{name}: {each} {coarse[each]:.3g}" for each, bound in case.bounds.items() if coarse[each] > bound]
    for figure, group in FIGURES.items():
        if set(group) <= set(names):
            draw_differences({name: stated("cases", name) for name in group}, flown, FOLDER / figure)
    return beyond


def compare_models(python: str, names: tuple[str, ...]) -> list[str]:
    """Print the table of models at the same inputs; what is beyond its bound."""
    print_row(comparison.HEADS, begins=True)
    beyond = []
    for name in names:
        case: Comparison = stated("models", name)
        apart = relative_differences(case, *tables("models", name, python))
        print_row(comparison_row(case, apart))
        beyond += [f"{name}: {each} {apart[each]:.3g}" for each, bound in case.bounds.items() if apart[each] > bound]
    return beyond


def compare_swings(python: str, names: tuple[str, ...]) -> list[str]:
    """Print the table of flights with modes; what is beyond its bound."""
    print_row(swing.HEADS, begins=True)
    beyond = []
    for name in names:
        case: Swing = stated("swings", name)
        whole, tenth = (swing_differences(case, *tables("swings", name, python, size)) for size in (1.0, TENTH))
        print_row(swing_row(case, whole, tenth))
        if whole[1] < case.fall * tenth[1]:
            beyond.append(f"{name}: fall {whole[1] / tenth[1]:.3g}")
        if whole[1] > case.bound * whole[0]:
            beyond.append(f"{name}: rate {whole[1]:.3g}")
    return beyond


def stated(folder: str, name: str) -> Any:
    """Return the statement of a case."""
    return import_module(f"crosscheck.{folder}.{name}.case").CASE


def print_row(texts: Iterable[str], begins: bool = False) -> None:
    """Print a row of a table, at its begin with the line below."""
    row = tuple(texts)
    print(f"| {' | '.join(row)} |", *([f"|{' --- |' * len(row)}"] if begins else []), sep="\n", flush=True)


def statements(names: Iterable[str]) -> list[str]:
    """Return the rows of a table of cases: the declarations of each flight."""
    rows = ["| case | verifies | gravitation | environment | integrator | matched how |", f"|{' --- |' * 6}"]
    for name in names:
        case: Case = stated("cases", name)
        texts = (case.title, case.verifies, case.gravitation, case.environment, case.integrator, case.matched)
        rows.append(f"| {' | '.join(texts)} |")
    return rows


def row_of(case: Case, coarse: dict[str, float], fine: dict[str, float]) -> list[str]:
    """Return the row of a case: the largest differences with its step, and their decrease with half of it."""
    orders = [np.log2(coarse[each] / fine[each]) for each in case.quantities if coarse[each] > 0.0 < fine[each]]
    order = float(np.median(orders))
    numbers = [f"{coarse[each]:.1e}" if each in coarse else "" for each in QUANTITIES]
    return [case.title, f"{case.step:g}", *numbers, f"{order:.1f}" if order > ROUNDING else "rounding"]


if __name__ == "__main__":
    interpreter, *chosen = sys.argv[1:]
    sys.exit(1 if main(interpreter, tuple(chosen) or (*CASES, *MODELS, *SWINGS)) else 0)
