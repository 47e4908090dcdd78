"""Sweeps: a parameter set to low:high:step by `--set` of a batch becomes a grid draw of the campaign."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from ....common.bounds import GRID_POINTS
from ....common.errors import InputError
from ...runtime.system.assignments import SINGLE
from ...runtime.system.options import STEP_ROUNDING, SystemOptions
from ..draws.interfaces import Draw
from .campaign import MAXIMUM_GROUPS, Campaign
from .distributions import Grid


def split_sweeps(options: SystemOptions) -> tuple[SystemOptions, dict[str, str]]:
    """Return system options without their sweeps, and the sweeps as texts by parameter.

    A sweep is a text of three numbers separated by colons. Other texts are left to the code that sets single values,
    which knows whether a parameter accepts text.
    """
    sweeps = {
        name: value.strip() for name, value in options.set.items() if isinstance(value, str) and _parse_range(value)
    }
    single = {name: value for name, value in options.set.items() if name not in sweeps}
    return options.replace(set=single), sweeps


def with_sweeps(campaign: Campaign, sweeps: Mapping[str, str]) -> Campaign:
    """Return the campaign with swept parameters on a grid, combined with the campaign's own grids.

    ``sweeps`` are texts low:high:step by parameter, in the parameter's unit; the values are low + k step, up to and
    including high. They replace values of the campaign's [set]. A single sweep also groups the results if the campaign
    has no group. Raises InputError for a sweep that is malformed, or that the campaign excludes.
    """
    if not sweeps:
        return campaign
    sampled = campaign.input_names()
    grids = {name: Grid(_values(name, text)) for name, text in sweeps.items()}
    draws = [Draw(name, (name,), grid) for name, grid in grids.items()]
    for name, text in sweeps.items():
        if "." not in name:
            raise InputError(
                SINGLE,
                f"{name}={text}",
                "not a component's variable",
                "give component.variable",
            )
        if name in sampled:
            problem = "the campaign draws it in every trial"
            raise InputError(SINGLE, f"{name}={text}", problem, "omit this sweep, or remove the draw from the campaign")
        if campaign.requirements:
            problem = "the campaign has requirements, and their verdicts need independent trials"
            raise InputError(SINGLE, f"{name}={text}", problem, "sweep a campaign without requirements")
    swept = replace(
        campaign,
        draws=(*campaign.draws, *draws),
        settings={name: value for name, value in campaign.settings.items() if name not in sweeps},
        sweeps=dict(sweeps),
    )
    _check_trials(swept)
    (first, *others) = draws
    if others or campaign.group is not None or len(grids[first.name].values) > MAXIMUM_GROUPS:
        return swept
    return replace(swept, group=first.name)


def _parse_range(text: str) -> list[float]:
    """Return the three numbers of a sweep; an empty list if the text is no sweep."""
    try:
        ends = [float(part) for part in text.split(":")]
    except ValueError:
        return []
    return ends if len(ends) == 3 else []


def _values(name: str, text: str) -> tuple[float, ...]:
    place = f"{name}={text}"
    numbers = _parse_range(text)
    if not numbers or not all(map(math.isfinite, numbers)):
        raise InputError(SINGLE, place, "not a sweep", "write low:high:step with three numbers")
    low, high, step = numbers
    if not step > 0.0:
        raise InputError(SINGLE, place, f"the step {step:g} is not positive", "write low:high:step, such as 1:5:0.5")
    if not high > low:
        problem = f"high = {high:g} is not above low = {low:g}"
        raise InputError(SINGLE, place, problem, "write low:high:step with low < high, or one value")
    steps = (high - low) / step + STEP_ROUNDING
    GRID_POINTS.check(steps, SINGLE, place)
    if steps < 1.0:
        raise InputError(
            SINGLE, place, f"the step {step:g} reaches no value beyond low = {low:g}", "give a shorter step"
        )
    return tuple(low + k * step for k in range(math.floor(steps) + 1))


def _check_trials(campaign: Campaign) -> None:
    """Reject a number of trials that is not a multiple of the number of points on all grids."""
    grids = [draw.distribution for draw in campaign.draws if isinstance(draw.distribution, Grid)]
    points = math.prod(len(grid.values) for grid in grids)
    if campaign.trials % points:
        swept = ", ".join(f"{name}={text}" for name, text in campaign.sweeps.items())
        below = campaign.trials // points * points
        some = f"{below} or {below + points}" if below else f"{points}"
        problem = f"{campaign.trials} trials do not fill a grid of {points} points"
        raise InputError(SINGLE, swept, problem, f"give a multiple of {points}: `trials` {some}")
