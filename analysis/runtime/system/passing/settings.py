"""The values that a system starts with."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...ssp.given_values import ParameterValue
from ...ssp.parameter_sets import Assignment


@dataclass
class Settings:
    """Values by (component, variable), and of system connectors by node name; ``origins``: where each comes from.

    ``left_out`` is where values come from that no mapping passes on, by what they would be applied to without one.
    ``chosen`` are the values that options give, ``replaced`` what parameters of the system take the place of: the
    parameter's name and the value before, by component and variable.
    """

    variables: dict[tuple[str, str], ParameterValue] = field(default_factory=dict)
    origins: dict[tuple[str, str], str] = field(default_factory=dict)
    node_origins: dict[str, str] = field(default_factory=dict)
    nodes: dict[str, float | str] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    chosen: list[Assignment] = field(default_factory=list)
    replaced: dict[tuple[str, str], tuple[str, ParameterValue]] = field(default_factory=dict)
