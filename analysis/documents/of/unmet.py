"""Lines on requirements of the option `require` that are not met, for simulations, campaigns and studies."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ...campaigns.definition.expressions import Expression


def requirement_problems(requirements: Sequence[Expression], values: Mapping[str, float]) -> list[str]:
    """Return a line for each requirement that is not met, or whose numbers are missing or not finite."""
    return [
        f"`require`: {requirement.text}: not met"
        for requirement in requirements
        if not all(math.isfinite(values.get(name, math.nan)) for name in requirement.names)
        or not requirement.evaluate(values)
    ]
