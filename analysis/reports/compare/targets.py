"""Where the flights of a contender were to end, and where they did."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...campaigns.compare.comparison import Contender
from .recorded import find_vector, vectors

UNITS = {"position": "m", "velocity": "m/s"}


@dataclass(frozen=True)
class Target:
    """A vector per trial; ``name`` is the parameter that says so, empty where none does and it is zero."""

    name: str
    values: np.ndarray


@dataclass(frozen=True)
class Ends:
    """What a contender's flights missed by at the end: final less target, trials by elements, SI."""

    signal: str
    variable: str
    target: str
    errors: np.ndarray
    success: np.ndarray


def target_of(contender: Contender, variable: str) -> Target:
    """The parameter target_VARIABLE of some component, as drawn where it is drawn; zeros where there is none."""
    count = len(contender.trials.trial)
    known = {
        name: value
        for name, value in contender.stored.document.get("targets", {}).get(contender.name, {}).items()
        if contender.stored.parted(name)[1].startswith(f"target_{variable}[")
    }
    for base, elements in vectors(known).items():
        drawn = contender.stored.draws
        columns = [drawn.get(name, np.full(count, known[name])) for name in elements]
        return Target(base, np.stack(columns, axis=1).astype(float))
    return Target("", np.zeros((count, 3)))


def ends_of(contender: Contender, variable: str) -> Ends | None:
    """Final position or velocity less its target; None where the batch does not keep the final values."""
    found = find_vector(contender.stored, contender.trials.final, variable, UNITS[variable])
    if found is None:
        return None
    target = target_of(contender, variable)
    finals = np.stack([contender.trials.final[name] for name in found], axis=1)
    return Ends(found[0].removesuffix("[1]"), variable, target.name, finals - target.values, contender.trials.success)
