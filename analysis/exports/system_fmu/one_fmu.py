"""Request for the export of a system as one FMU."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ....common.errors import InputError
from ...runtime.system.options import SystemOptions


@dataclass(frozen=True)
class OneFmu:
    """Request for the export of a system as one FMU. Raises InputError.

    ``slots`` maps components to their candidates, ``exposed`` lists the signals to expose, and ``faulty`` the
    connectors and tunable parameters with fault inputs. ``options`` are the options of the system.
    """

    slots: Mapping[str, Sequence[str]]
    exposed: Sequence[str]
    faulty: Sequence[str]
    options: SystemOptions

    def __post_init__(self) -> None:
        for slot, candidates in self.slots.items():
            if not all(candidates) or not candidates:
                problem = "a candidate has an empty name"
                raise InputError("`slots`", f"{slot}={','.join(candidates)}", problem, "give SLOT=FMU,FMU")
            if slot in self.options.use and self.options.use[slot] not in candidates:
                problem = f"`use` gives {self.options.use[slot]}, which is not among the candidates"
                raise InputError("`slots`", slot, problem, "add this FMU to the candidates, or leave out `use`")
