"""Comparison of the choices of docs/modal_synthesis.md: `python -m docs.figures.modal_comparison`.

Prints the page's tables and draws docs/images/modal/*.svg. Random systems: elements of A, B and C normal, real poles
from -4 to -0.5, at least 0.2 apart.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.signal import place_poles
from tqdm import tqdm

from perilune.analysis.design.poles.output_feedback import output_feedback
from perilune.analysis.design.poles.place import place
from perilune.analysis.design.poles.spectrum import Spectrum
from perilune.analysis.documents.common.style import house_style
from perilune.common.paths import ROOT

from .modal_figures import choices_figure, free_figure, spreads_figure
from .pictures import write_picture

SYSTEMS = 20
SIZES = ((4, 2), (6, 2), (6, 3))
OUTPUT = (6, 3, 4)
WAYS = ("place_poles", "diagonal", "least_condition", "least_norm")
KAPPA, NORM = 0, 1


def draws(
    states: int, inputs: int, outputs: int = 1
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]]:
    """Yield A, B, C and poles of the random systems; the sequence is reproducible."""
    random = np.random.default_rng([states, inputs, outputs])
    for _ in range(SYSTEMS):
        poles = np.zeros(states)
        while np.min(np.diff(np.sort(poles))) < 0.2:
            poles = random.uniform(-4.0, -0.5, states)
        a, b, c = (random.normal(size=size) for size in ((states, states), (states, inputs), (outputs, states)))
        yield a, b, c, poles


def state_feedback(states: int, inputs: int) -> np.ndarray:
    """Return the condition number kappa and the norm |K| of each design, (systems, ways, 2)."""
    numbers = []
    for a, b, _, poles in tqdm(list(draws(states, inputs)), desc=f"n, m = {states}, {inputs}", disable=None):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it warns where 30 iterations were too few
            gain = place_poles(a, b, poles).gain_matrix
        vectors = np.linalg.eig(a - b @ gain)[1]
        ours = [place(a, b, poles, choice=choice) for choice in WAYS[1:]]
        numbers.append([(np.linalg.cond(vectors), np.linalg.norm(gain, 2)), *((one.kappa, one.norm) for one in ours)])
    return np.array(numbers)


def iterate_gain_norms() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return |F| of every real spread of the poles.

    Direct (systems, 20), dual (systems, 15), and of the choice "smallest" (systems, 1).
    """
    states, inputs, outputs = OUTPUT
    numbers: tuple[list, list, list] = ([], [], [])
    for a, b, c, poles in tqdm(list(draws(*OUTPUT)), desc="n, m, p = {}, {}, {}".format(*OUTPUT), disable=None):
        for norms, method, size in zip(numbers, ("direct", "dual"), (states - inputs, states - outputs), strict=False):
            uppers = [upper.poles for upper, _ in Spectrum.of(poles, states).splits(size)]
            norms.append([output_feedback(a, b, c, poles, method=method, upper=upper).norm for upper in uppers])
        numbers[2].append([output_feedback(a, b, c, poles, choice="smallest").norm])
    return np.array(numbers[0]), np.array(numbers[1]), np.array(numbers[2])


def tables(table: dict[tuple[int, int], np.ndarray], direct: np.ndarray, dual: np.ndarray, smallest: np.ndarray) -> str:
    """Return the page's tables: medians over the systems."""
    lines = [f"medians over {SYSTEMS} systems each", f"{'n, m':6}" + "".join(f"{way:>18}" for way in WAYS)]
    for what, name in ((KAPPA, "kappa"), (NORM, "|K|")):
        lines.append(name)
        lines += [
            f"{states}, {inputs}  " + "".join(f"{value:18.3g}" for value in np.median(numbers[:, :, what], axis=0))
            for (states, inputs), numbers in table.items()
        ]
    lines.append("median of kappa, least_condition / place_poles")
    lines += [
        f"{states}, {inputs}  {np.median(numbers[:, 2, KAPPA] / numbers[:, 0, KAPPA]):18.3g}"
        for (states, inputs), numbers in table.items()
    ]
    lines.append("|F|, n, m, p = {}, {}, {}: first spread, best direct, best of all, smallest".format(*OUTPUT))
    columns = (direct[:, 0], direct.min(axis=1), np.hstack([direct, dual]).min(axis=1), smallest)
    lines.append("  ".join(f"{np.median(one):.3g}" for one in columns))
    return "\n".join(lines)


def draw(folder: Path, figures: dict[str, Figure]) -> list[Path]:
    """Write the figures to an existing folder and print their paths."""
    paths = [folder / f"modal_{name}.svg" for name in figures]
    for path, figure in zip(paths, figures.values(), strict=True):
        write_picture(figure, path)
    return paths


if __name__ == "__main__":
    medians = {size: state_feedback(*size) for size in SIZES}
    norms = iterate_gain_norms()
    print(tables(medians, *norms))
    with house_style():
        kappa, norm = (
            {
                f"{n}, {m}": numbers[:, WAYS.index(way), what] / numbers[:, 0, what]
                for (n, m), numbers in medians.items()
            }
            for what, way in ((KAPPA, "least_condition"), (NORM, "least_norm"))
        )
        drawn = {"choices": choices_figure(kappa, norm), "spreads": spreads_figure(*norms), "free": free_figure()}
        print(*draw(ROOT / "docs" / "images" / "modal", drawn), sep="\n")
