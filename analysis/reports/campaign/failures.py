"""Where in the space of draws the failures of a batch lie."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes

from ...campaigns.draws.declared import drawn_names
from ...campaigns.fly.results import BatchResult
from ..common.panels import Panel, panel
from ..common.style import GRID, VERMILION, plain_ticks

HEIGHT = 3.2  # in
GOOD = "#9a9a9a"
MANY = 3000  # points of a panel from which on they are stored as an image, not one by one


def successes(result: BatchResult, variant: str) -> np.ndarray:
    """Whether each trial of a variant that figures show was a success."""
    return result.shown[variant].dots.success


def telling_scores(result: BatchResult, variant: str) -> dict[str, float]:
    """How much each draw tells about success, 0 to 1, most telling first.

    The larger of two correlations with success, without their signs: of the draw's value, and of
    its distance from its mean, which sees failures at both ends. Only draws that vary count, not
    what is derived from them; without both failures and successes there is nothing to tell.
    """
    good = successes(result, variant).astype(float)
    if good.min() == good.max():
        return {}
    scores = {}
    for name in drawn_names(result.plan.campaign):
        values = result.shown[variant].dots.draws[name]
        candidates = (values, np.abs(values - values.mean()))
        found = [abs(float(np.corrcoef(good, column)[0, 1])) for column in candidates if np.ptp(column) > 0.0]
        if found:
            scores[name] = max(found)
    return dict(sorted(scores.items(), key=lambda item: -item[1]))


def failure_panels(result: BatchResult) -> list[Panel]:
    """Failures and successes over the two most telling draws of each variant for which something can be told."""
    chosen = {variant: list(telling_scores(result, variant))[:2] for variant in result.rows}

    def drawing(variant: str, names: list[str]) -> Callable[[Axes], None]:
        return lambda axes: _draw_panel(axes, result, variant, names)

    return [
        panel(
            variant,
            f"failures-{index}",
            _words(variant, names),
            drawing(variant, names),
            HEIGHT,
        )
        for index, (variant, names) in enumerate(chosen.items())
        if names
    ]


def _words(variant: str, names: list[str]) -> str:
    return f"Failures of {variant} over {' and '.join(names)}"


def _draw_panel(axes: Axes, result: BatchResult, variant: str, names: list[str]) -> None:
    good = successes(result, variant)
    drawn = result.shown[variant].dots.draws
    x = drawn[names[0]]
    y = drawn[names[1]] if len(names) > 1 else np.arange(good.size, dtype=float)
    image = good.size > MANY
    size = max(0.35, min(1.0, (500.0 / good.size) ** 0.5))
    axes.plot(
        x[good], y[good], "o", markersize=3.0 * size, color=GOOD, markeredgewidth=0.0, rasterized=image,
        label=f"{int(good.sum())} successes",
    )  # fmt: skip
    axes.plot(
        x[~good], y[~good], "x", markersize=4.5 * size, color=VERMILION, markeredgewidth=1.3 * size, rasterized=image,
        label=f"{int((~good).sum())} failures",
    )  # fmt: skip
    plain_ticks(axes, x=5, y=6)
    axes.grid(color=GRID)
    axes.set_xlabel(names[0])
    axes.set_ylabel(names[1] if len(names) > 1 else "trial")
    axes.legend(
        loc="lower left",
        bbox_to_anchor=(-0.02, 1.0),
        ncols=2,
        borderpad=0.2,
        handletextpad=0.2,
        columnspacing=1.0,
        markerscale=1.0 / size,
    )
