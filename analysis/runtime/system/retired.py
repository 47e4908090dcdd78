"""FMUs that became another FMU with values of its parameters: their names are accepted for one release, with a note."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from ....fmus_src.export.available import fmu_file
from ....fmus_src.paths import FLAVOURS, SYSTEMS
from ..ssp.parameter_sets import Assignment, SetValue, read_parameter_file
from .assignments import single_value

GAINS = SYSTEMS / "entry_attitude"  # its parameter sets write the component as `regulator`


@dataclass(frozen=True)
class Retired:
    """``block`` takes the FMU's place with ``values`` of its parameters or with those of ``parameter_set``."""

    block: str
    values: Mapping[str, SetValue] = field(default_factory=dict)
    parameter_set: str | None = None

    def assignments(self, component: str) -> Iterator[Assignment]:
        """The values, for a component that flew the retired FMU."""
        for name, value in self.values.items():
            yield single_value(f"{component}.{name}", value)
        if self.parameter_set is not None:
            path = GAINS / self.parameter_set
            for each in read_parameter_file(path.read_bytes(), str(path)):
                yield replace(each, name=f"{component}.{each.name.partition('.')[2]}")

    def note(self, component: str, name: str) -> str:
        """What to write instead."""
        values = [f"{component}.{each} = {str(value).lower()}" for each, value in self.values.items()]
        instead = " and ".join([self.block, *values, *filter(None, [self.parameter_set])])
        return f"{component}: {name} is retired and accepted in this release only: use {instead}"


RETIRED = {
    f"output_feedback_{name}": Retired("output_feedback", parameter_set=f"output_feedback_{name}.ssv")
    for name in ("direct1", "direct0", "dual_a", "dual_b", "scheduled")
} | {
    "orbital_observer_continuous_split": Retired("orbital_observer_continuous", {"split": True}),
    "orbital_observer_discrete_split": Retired("orbital_observer_discrete", {"split": True}),
    "orbital_observer_discrete_reduced_split": Retired("orbital_observer_discrete_reduced", {"split": True}),
    "pulse_allocation_mean": Retired("pulse_allocation", {"mean": True}),
}


def find_retired(name: str, system: Path) -> Retired | None:
    """What replaces an FMU given by its block's name; None where it is not retired, or the user has one so called."""
    retired = RETIRED.get(name)
    if retired is None or any(fmu_file(name, flavour, system) is not None for flavour in FLAVOURS):
        return None
    return retired
