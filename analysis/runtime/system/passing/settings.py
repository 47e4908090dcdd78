"""Initial values of a system."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...ssp.parameter_sets import Assignment
from ...ssp.parameter_values import ParameterValue


@dataclass
class SystemSettings:
    """Values by (component, variable), those of system connectors by name, and the ``origins`` of both.

    ``left_out`` is the origin of each value that a mapping omits, by the name to which it would apply without the
    mapping. ``chosen`` are values of options; ``replaced`` are, by component and variable, the system parameter that
    replaced a value, and that value.
    """

    variables: dict[tuple[str, str], ParameterValue] = field(default_factory=dict)
    origins: dict[tuple[str, str], str] = field(default_factory=dict)
    node_origins: dict[str, str] = field(default_factory=dict)
    nodes: dict[str, float | str] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    chosen: list[Assignment] = field(default_factory=list)
    replaced: dict[tuple[str, str], tuple[str, ParameterValue]] = field(default_factory=dict)
