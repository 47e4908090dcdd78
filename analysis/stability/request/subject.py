"""The system under study with a user's options, and what is changed of them; FMUs are loaded once for all."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from ...runtime.system.fmu import Fmu
from ...runtime.system.options import Layer, SystemOptions
from ...runtime.system.prepared import PreparedSystem, prepare_system
from .declaration import Point


@dataclass(frozen=True)
class Subject:
    """A system and options; `changed` gives another one that shares its loaded FMUs."""

    system: str
    options: SystemOptions
    fmus: dict[str, Fmu] = field(default_factory=dict)

    def with_options(self, *, step: float | None = None, **layers: Layer) -> Subject:
        """With another communication step (s), and with what others ask, by the names of `LAYERS`."""
        options = self.options.among(**layers)
        return replace(self, options=options if step is None else replace(options, step=step))

    def at(self, point: Point, study: Layer | None = None) -> PreparedSystem:
        """The system at a point, with ``study`` over all other layers. Raises InputError."""
        options = self.options.among(operating_point=point.layer, study=study or Layer())
        return prepare_system(self.system, options, self.fmus)
