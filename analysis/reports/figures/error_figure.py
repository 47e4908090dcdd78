"""An estimate less the truth, with what the estimator states of it: the whole flight, and to the scale of its end."""

from __future__ import annotations

import numpy as np
import scipy
from markupsafe import Markup
from matplotlib.axes import Axes

from ...common.percent import short_percent
from ...runtime.flight.results import Result
from ..common.panels import Panel
from ..common.quantities import shown_unit
from ..common.style import BLUE, FAINT, ORANGE
from .declaration.figures import Error
from .section import Section, capital, choice, chosen_rows, history_panel, nothing_chosen, seconds, sentence, trimmed

SIGMAS = (3.0, 1.0)
MOST_ROWS = 500  # of the shades, which nothing simplifies
ROUNDING = 1e-12  # of times, which are start + n h
FAR = 4.0  # times the extent of the last quarter from which on the whole flight leaves too little of it to see


def error_section(error: Error, result: Result, name: str) -> Section:
    """The figures and findings of an error; ``name`` must differ between the figures of a page."""
    chosen = chosen_rows(error.rows, result)
    if error.rows is not None and not chosen.any():
        return nothing_chosen(error.title, error.rows)
    rows = trimmed(chosen)
    time = result.time[rows]
    values = np.where(chosen, error.estimate.shown(result) - error.truth.shown(result), np.nan)[:, rows]
    stated = np.zeros_like(values) if error.sigma is None else error.sigma.shown(result)[:, rows]
    sigma = np.where(stated > 0.0, stated, np.nan)
    panels: list[Panel] = []
    findings: list[Markup] = []
    for index, label in enumerate(error.labels):
        panels += _panels(error, label, time, values[index], sigma[index], f"{name}-{index}")
        findings += _findings(error, label, time, values[index], sigma[index])
    return Section(
        title=error.title,
        panels=panels,
        findings=findings,
        notes=[*_reading(error, sigma), *(Markup("{}").format(note) for note in error.notes)],
    )


def _panels(
    error: Error, label: str, time: np.ndarray, values: np.ndarray, sigma: np.ndarray, name: str
) -> list[Panel]:
    unit = shown_unit(error.estimate.unit_name)
    what = f"{error.title}: {label or error.estimate.label} over time"
    head = f"{label}, " if label else ""

    def draw(axes: Axes, reach: float | None = None) -> None:
        rows = np.linspace(0, time.size - 1, min(time.size, MOST_ROWS)).round().astype(int)
        for times, shade in zip(SIGMAS, (0.20, 0.40), strict=True):
            half = times * sigma[rows]
            axes.fill_between(time[rows], -half, half, color=ORANGE, alpha=shade, linewidth=0.0)
        axes.axhline(0.0, color=FAINT, linewidth=0.8)
        axes.plot(time, values, color=BLUE, marker="." if time.size == 1 else "")
        if reach is not None:
            axes.set_ylim(-reach, reach)

    panels = [history_panel(capital(f"{head}the whole flight"), f"{name}-whole", what, unit, time, draw)]
    reach = _reach_of_the_end(values, sigma)
    if reach is not None:
        words = capital(f"{head}to the scale of the last quarter")
        panels.append(
            history_panel(words, f"{name}-end", f"{what}, its end", unit, time, lambda axes: draw(axes, reach))
        )
    return panels


def _reach_of_the_end(values: np.ndarray, sigma: np.ndarray) -> float | None:
    """How far from 0 the last quarter goes, its deviations too; None where the whole flight shows it well."""
    sizes = np.fmax(np.abs(values), np.fmax(SIGMAS[0] * sigma, 0.0))
    later = sizes[3 * values.size // 4 :]
    if not np.any(later > 0.0) or np.nanmax(sizes) <= FAR * np.nanmax(later):
        return None
    return 1.1 * float(np.nanmax(later))


def _findings(error: Error, label: str, time: np.ndarray, values: np.ndarray, sigma: np.ndarray) -> list[Markup]:
    """The shares of the time within sigma and three of it; nothing where none is stated."""
    start = time[0] if error.after is None else error.after
    told = np.isfinite(sigma) & np.isfinite(values) & (time >= start - ROUNDING * abs(start))
    if not np.any(told):
        return []
    shares = [float(np.mean(np.abs(values[told]) <= times * sigma[told])) for times in SIGMAS]
    words = Markup("{}from {} on {} of the time within sigma ({} of a normal error would be), {} within three").format(
        f"{label}: " if label else "", seconds(start), _percent(shares[1]), _percent(_normal(1.0)), _percent(shares[0])
    )
    return [sentence(words)]


def _normal(times: float) -> float:
    return float(2.0 * scipy.stats.norm.cdf(times) - 1.0)


def _percent(share: float) -> Markup:
    return Markup('<data value="{}">{}</data> %').format(repr(share), short_percent(share, 1))


def _reading(error: Error, sigma: np.ndarray) -> list[Markup]:
    words = Markup("line: {} less {}").format(error.estimate.label, error.truth.label)
    if error.sigma is not None and not np.any(np.isfinite(sigma)):
        words = Markup("{}; {} states no deviation, it is 0 throughout").format(words, error.sigma.label)
    elif error.sigma is not None:
        gaps = ", where it is not 0" if not np.all(np.isfinite(sigma)) else ""
        words = Markup("{}; shaded: one and three of {} either way{}").format(words, error.sigma.label, gaps)
    if error.rows is not None:
        words = Markup("{}; where {}").format(words, choice(error.rows))
    return [sentence(words)]
