"""A law as a parameter set (.ssv) for the component that flies it."""

from __future__ import annotations

from ...runtime.ssp.parameter_sets import write_parameter_set
from .law import EXP_SATURATIONS, Law


def law_parameters(law: Law, component: str) -> dict[str, int | float]:
    """The law as values of ``component``'s parameters matrix, q and exp_saturation, by name."""
    values: dict[str, int | float] = {}
    for row, entries in enumerate(law.matrix, 1):
        for column, entry in enumerate(entries, 1):
            values[f"{component}.matrix[{row},{column}]"] = entry
    for place, value in enumerate(law.q, 1):
        values[f"{component}.q[{place}]"] = value
    values[f"{component}.exp_saturation"] = EXP_SATURATIONS.index(law.exp_saturation)
    return values


def parameter_set(law: Law, component: str) -> bytes:
    """The content of an .ssv file with the whole law, zeros of the matrix included."""
    return write_parameter_set(law.name, law_parameters(law, component), law.description)
