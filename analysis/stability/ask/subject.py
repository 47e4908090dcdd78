"""The system under study with a user's options, and what is changed of them; FMUs are loaded once for all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from ...system.fmu import Fmu
from ...system.options import SystemOptions
from ...system.parameter_sets import ParameterValue
from ...system.prepared import PreparedSystem, prepare_system
from .declaration import Point


@dataclass(frozen=True)
class Subject:
    """A system and options; `changed` gives another one that shares its loaded FMUs."""

    system: str
    options: SystemOptions
    fmus: dict[str, Fmu] = field(default_factory=dict)

    def changed(
        self,
        *,
        step: float | None = None,
        parameters: Sequence[str] = (),
        set: Mapping[str, ParameterValue] | None = None,
    ) -> Subject:
        """With another communication step (s), parameter sets before the user's, values over the user's."""
        options = replace(
            self.options,
            step=self.options.step if step is None else step,
            parameters=(*parameters, *self.options.parameters),
            set={**self.options.set, **(set or {})},
        )
        return replace(self, options=options)

    def at(self, point: Point, use: Mapping[str, str] | None = None) -> PreparedSystem:
        """The system at a point, with the FMUs of ``use`` over all others. Raises InputError.

        The user's --use and --set win over the point's, and the point's values over all parameter sets.
        """
        options = replace(
            self.options,
            use={**point.use, **self.options.use, **(use or {})},
            parameters=(*point.parameters, *self.options.parameters),
            set={**point.set, **self.options.set},
        )
        return prepare_system(self.system, options, self.fmus)
