"""Result of a simulation: signals over time, termination, component status, provenance."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, NotRequired, Self, TypedDict

import numpy as np

from ....common.atomic import whole_file, write_atomically
from ....common.errors import suggestion
from ....common.percent import short_percent
from ....common.visible import quote_formula
from ....fmus_src.roles import STATUS
from ...options.fault import Fault
from ..ssp.names import elements, split_name, vectors
from ..ssp.parameter_values import ParameterValue
from ..ssp.types import WHOLE
from ..system.arrays.axis_names import names_of_axes
from ..system.inputs import DrivenInput, InputFacts
from ..system.network import Network
from ..system.passing.settings import SystemSettings
from ..system.prepared import PreparedSystem
from .parameters import Parameters

if TYPE_CHECKING:  # imported where a table is written
    import pyarrow

NONFINITE = "nonfinite"
TIMED_OUT = "timed_out"
CRASHED, HUNG, OUT_OF_MEMORY = LOST = (
    "crashed",
    "hung",
    "out_of_memory",
)  # statuses of simulations that lost their process or thread
COMPLETE = ("finished", "stop_time", "terminated")
ENDINGS = {
    "finished": "completed",
    "stop_time": "stop time reached",
    TIMED_OUT: "timed out",
    OUT_OF_MEMORY: "out of memory",
}  # text of a status, if it differs from the status itself


def require_pandas() -> None:
    """Raise ImportError if pandas is missing; its message contains the command that installs pandas."""
    if find_spec("pandas") is None:
        raise ImportError("to_pandas needs pandas, which is not installed; pip install 'perilune[notebook]'")


@dataclass(repr=False)
class Flight:
    """One simulation in memory. Row n of every signal is its value at ``time[n]`` (s).

    ``status`` is one of

    - ``finished``: the system ended itself
    - ``stop_time``: the stop time was reached
    - ``terminated``: an FMU asked to end the simulation
    - ``nonfinite``: a component returned NaN or infinity
    - ``failed``: an FMU reported an error, or did not accept a parameter
    - ``interrupted``: the simulation was ended by Ctrl-C
    - ``timed_out``: the simulation exceeded its time limit
    - ``crashed``: an FMU ended its process
    - ``hung``: a call of an FMU did not return
    - ``out_of_memory``: the simulation exceeded its memory limit

    ``message`` explains all but the first two. ``signals`` are float64 arrays, also for Integers and Booleans;
    ``types`` contains their FMI types.
    """

    time: np.ndarray
    signals: dict[str, np.ndarray]
    types: dict[str, str]
    status: str
    message: str

    def __getitem__(self, name: str) -> np.ndarray:
        """Return the signal ``component.variable``, of shape [n], or a vector of k elements by its name, [n, k].

        Raises KeyError, which suggests the most similar names.
        """
        if name in self.signals:
            return self.signals[name]
        parts = elements(name, self.signals)
        if not parts:
            raise KeyError(f"no signal {name}; {suggestion(name, [*self.signals, *vectors(self.signals)])}")
        return np.stack([self.signals[part] for part in parts], axis=1)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.ending}, {len(self.signals)} signals)"

    @property
    def ending(self) -> str:
        """Cause and time of the end, and the number of samples, as text."""
        end = f" at t = {self.time[-1]:g} s" if self.time.size else ""
        return f"{ENDINGS.get(self.status, self.status)}{end}, {self.time.size} samples"

    @property
    def complete(self) -> bool:
        return self.status in COMPLETE

    def final(self) -> dict[str, float | int | bool]:
        """Return the last value of each signal, in the signal's type."""
        convert = {"Integer": int, "Enumeration": int, "Boolean": bool}
        if not self.time.size:
            return {}
        return {name: convert.get(self.types[name], float)(values[-1]) for name, values in self.signals.items()}


class Provenance(TypedDict):
    """Inputs that determine a simulation, serialisable as JSON. Times in s."""

    system: str
    system_sha256: str
    fmus: dict[str, dict[str, str]]
    parameters: dict[str, ParameterValue]
    start_time: float
    step: float
    stop_time: float
    variant: str | None
    feedthrough: list[str]
    no_feedthrough: list[str]
    assumptions: list[str]
    faults: list[str]
    algorithm: str
    input: NotRequired[DrivenInput]
    relative_quantities: NotRequired[list[str]]  # signals that are differences in their unit
    axes: NotRequired[dict[str, str]]  # names of axes, by signal, for elements of vectors with named axes
    perilune: str


def _column_type(type_name: str, values: np.ndarray) -> pyarrow.DataType:
    """Return the Arrow type of a signal; integers beyond 32 bits become int64 or, beyond 64 bits, float64 (FMI 3.0)."""
    import pyarrow

    if type_name == "Boolean":
        return pyarrow.bool_()
    if type_name not in WHOLE:
        return pyarrow.float64()
    largest = max(values.max(initial=0.0), -values.min(initial=0.0))
    return pyarrow.int32() if largest < 2**31 else pyarrow.int64() if largest < 2**63 else pyarrow.float64()


@dataclass(repr=False)
class FlightResult(Flight):
    """Flight with the units of its signals and its provenance: parameter values, hashes and versions."""

    units: dict[str, str | None]
    provenance: Provenance

    @classmethod
    def extending(cls, flight: FlightResult, **more: Any) -> Self:
        """Return an instance of a subclass with the fields of ``flight`` and the additional fields ``more``."""
        return cls(**vars(flight), **more)

    def table(self) -> pyarrow.Table:
        """Return the signals as an Arrow table: time first, units and provenance in the metadata."""
        import pyarrow

        from ....common.machine.arrow import numbers_of

        arrays = [numbers_of(self.time)]
        fields = [pyarrow.field("time", pyarrow.float64(), metadata={"unit": "s"})]
        for name, values in self.signals.items():
            kind = _column_type(self.types[name], values)
            arrays.append(numbers_of(values).cast(kind))
            unit = self.units[name]
            fields.append(pyarrow.field(name, kind, metadata={"unit": unit} if unit else None))
        metadata = {"perilune": json.dumps(self.summary())}
        return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields, metadata=metadata))

    def summary(self) -> dict[str, object]:
        """Return status and provenance, without the signals."""
        last = float(f"{self.time[-1]:.12g}") if self.time.size else None  # 283.4, not 283.40000000000003
        ending = {"status": self.status, "message": self.message, "rows": int(self.time.size), "end_time": last}
        return {**ending, **self.provenance}

    def to_pandas(self) -> Any:
        """Return a pandas.DataFrame with one column for each signal, and the time (s) as its index. Requires pandas."""
        require_pandas()
        return self.table().to_pandas().set_index("time")

    def write(self, path: str | Path) -> None:
        """Write a .parquet or .csv file.

        A .json file next to a .csv file contains units, types other than Real, and provenance.
        """
        path = Path(path)
        if path.suffix == ".parquet":
            import pyarrow.parquet

            with whole_file(path) as partial:
                pyarrow.parquet.write_table(self.table(), partial)
        else:
            import pyarrow.csv

            plain = not any(mark in name for name in self.signals for mark in ',"')
            options = pyarrow.csv.WriteOptions(quoting_header="none" if plain else "needed")
            table = self.table().rename_columns([quote_formula(name) for name in ("time", *self.signals)])
            with whole_file(path) as partial:
                pyarrow.csv.write_csv(table, partial, options)
            units = {"time": "s"} | {name: unit for name, unit in self.units.items() if unit}
            types = {name: kind for name, kind in self.types.items() if kind != "Real"}
            text = json.dumps(self.summary() | {"units": units, "types": types}, indent=1)
            write_atomically(path.with_name(f"{path.name}.json"), f"{text}\n".encode())


MEANING = re.compile(r"(?:^|[,:] )(-?\d+):? (.+?)(?=, -?\d+:? |$)")  # "0 good, 1 clamped, 2 ..."


def status_lines(network: Network, flight: Flight) -> list[str]:
    """Return a line for every component that reported a status other than 0: worst status, duration, last status."""
    lines = []
    for name, values in flight.signals.items():
        component, variable = split_name(name, network.fmus)
        if variable != STATUS or not component or flight.types[name] not in WHOLE or not values.any():
            continue
        worst, last = int(np.max(values)), int(values[-1])
        first = float(flight.time[np.argmax(values == worst)])
        fraction = np.count_nonzero(values == worst) / values.size
        meaning = status_meaning(network, name, worst)
        value = f"{worst} ({meaning})" if meaning else f"{worst}"
        words = f"{name}: {value} from t = {first:g} s, {_percent(fraction)} of the samples"
        lines.append(words if last == worst else f"{words}, {last} at the end")
    return lines


def _percent(share: float) -> str:
    return "all" if share == 1.0 else f"{short_percent(share)} %"


def status_meaning(network: Network, name: str, value: int) -> str:
    """Return the meaning of a connector's status ``value``, from the connector's description, or ""."""
    component, variable = split_name(name, network.fmus)
    fmu = network.fmus.get(component)
    declared = fmu.variables.get(variable) if fmu is not None else None
    description = (declared.description or "") if declared is not None else ""
    meanings = {int(number): words for number, words in MEANING.findall(" ".join(description.split()))}
    return meanings.get(value, "").rstrip(".")


def with_meaning(network: Network, name: str, value: int) -> str:
    """Return a status with its meaning, such as ``guidance.status 3, no solution``."""
    words = status_meaning(network, name, value)
    return f"{name} {value}, {words}" if words else f"{name} {value}"


def provenance_of(
    prepared: PreparedSystem,
    settings: SystemSettings,
    parameters: Parameters,
    faults: Sequence[Fault | None],
    signals: Iterable[str],
) -> Provenance:
    """Return parameter values, hashes, options and version, and which ``signals`` are relative or have named axes."""
    units = {name: prepared.network.unit_of(name) for name in signals}
    axes = names_of_axes(prepared.network, units)
    relative = [name for name, unit in units.items() if unit is not None and unit.is_relative]
    provenance: Provenance = {
        "system": prepared.archive.name,
        "system_sha256": prepared.archive.digest,
        "fmus": {
            name: {"fmu": fmu.name, "sha256": fmu.digest, "guid": fmu.description.guid}
            for name, fmu in prepared.network.fmus.items()
        },
        "parameters": {
            f"{component}.{variable}": parameters[component, variable] for component, variable in settings.variables
        },
        "start_time": prepared.start,
        "step": prepared.step,
        "stop_time": prepared.start + prepared.steps * prepared.step,
        "variant": prepared.options.chosen["variant"],
        "feedthrough": list(prepared.options.chosen["feedthrough"]),
        "no_feedthrough": list(prepared.options.chosen["no_feedthrough"]),
        "assumptions": prepared.assumptions,
        "faults": [str(fault) for fault in faults if fault is not None],
        "algorithm": prepared.algorithm,
        **(prepared.drive.facts() if prepared.drive is not None else InputFacts()),
        "perilune": version("perilune"),
    }
    if relative:
        provenance["relative_quantities"] = relative
    if axes:
        provenance["axes"] = axes
    return provenance
