"""Initial values of a system."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...ssp.parameter_sets import Assignment
from ...ssp.parameter_values import ParameterValue


@dataclass
class SystemSettings:
    """Initial values of a system, by (component, variable) and by system connector, with the ``origins`` of both.

    ``left_out`` contains the origin of each value that a mapping omits, by the name to which the value would otherwise
    apply. ``chosen`` lists values from options. ``replaced`` maps (component, variable) to the system parameter that
    replaced a value, and to the replaced value.
    """

    variables: dict[tuple[str, str], ParameterValue] = field(default_factory=dict)
    origins: dict[tuple[str, str], str] = field(default_factory=dict)
    node_origins: dict[str, str] = field(default_factory=dict)
    nodes: dict[str, float | str] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    chosen: list[Assignment] = field(default_factory=list)
    replaced: dict[tuple[str, str], tuple[str, ParameterValue]] = field(default_factory=dict)
