"""docs/systems/earth_pointing.md: its tables by section, and the evaluation of simulations for its tests."""

import math
from collections.abc import Mapping

import numpy as np

from perilune.common.paths import ROOT

PAGE = (ROOT / "docs" / "systems" / "earth_pointing.md").read_text(encoding="utf-8")
ARCSEC = math.pi / 648000.0
WALK, STAR, PERIOD, FREQUENCY, DAMPING = 4.4e-5, 10.0 * ARCSEC, 0.5, 0.1, 0.9
NOISE = WALK * math.sqrt(DAMPING / FREQUENCY)  # rad: rates of density N^2 through w0^2, 2 z w0 have variance N^2 z/w0
ACROSS = np.array([[1.0, 0.0, 0.0], [0.0, 0.5, math.sqrt(0.75)]])  # of the boresight (0, sqrt(3)/2, -1/2)
NADIR = 2  # modes.mode


def section(title: str) -> str:
    """Return the text under a heading."""
    return PAGE.split(f"\n## {title}\n")[1].split("\n## ")[0]


def row(title: str, heading: str = "Results") -> list[str]:
    """Return the columns of a row after its title, in the section under a heading."""
    line = next(line for line in section(heading).splitlines() if line.startswith(f"| {title}"))
    return [cell.strip() for cell in line.strip("|").split("|")[1:]]


def scientific(value: float) -> str:
    """Format a number as the page writes it: 2.5e-4."""
    return f"{value:.1e}".replace("e-0", "e-")


def in_nadir(flight: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return True for the samples from 600 s after the beginning of the nadir mode on."""
    return (flight["modes.mode"] == NADIR) & (flight["modes.time_in_mode"] > 600.0)


def root_mean_square(values: np.ndarray) -> float:
    """Return the root of the mean square of all elements."""
    return math.sqrt(np.mean(np.square(values)))


def knowledge(flight: Mapping[str, np.ndarray]) -> float:
    """Return the error of the known attitude per axis across the star tracker's boresight in
    nadir mode (arcsec, rms)."""
    return root_mean_square(flight["monitor.knowledge_error"][in_nadir(flight)] @ ACROSS.T) / ARCSEC


def farrenkopf() -> float:
    """Return the standard deviation of a gyro-filtered attitude before a star sample (rad), without drift of the bias.

    Farrenkopf 1978: variance p before a sample of variance s, p = p s/(p + s) + N^2 T.
    """
    v = WALK * math.sqrt(PERIOD) / STAR
    before = STAR * math.sqrt((v**2 + v * math.sqrt(v**2 + 4.0)) / 2.0)
    p, s = before**2, STAR**2
    assert math.isclose(p * s / (p + s) + WALK**2 * PERIOD, p)
    return before
