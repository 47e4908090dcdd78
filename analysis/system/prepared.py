"""A system made ready: its files read, its FMUs loaded, everything checked before the first step."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ...fmus_src.export.available import fmu_file, fmu_flavours
from ...fmus_src.places import FLAVOURS
from ..errors import InputError, suggestion
from ..ssp.archive import HOW_TO_BUILD, SystemArchive, open_system
from ..ssp.description import Component
from ..ssp.parameter_sets import Assignment, read_parameter_file
from ..ssp.reading import read_description
from .assignments import Settings, collect_settings, single_value
from .checks import check_samples, unfit
from .fmu import Fmu, load_fmu
from .network import Network, build_network
from .options import ALGORITHMS, OPEN_INPUTS, SystemOptions
from .schedule import Schedule, make_schedule
from .times import component_periods, flight_times


@dataclass
class PreparedSystem:
    """A checked system; pass it to `Simulation`. Times in s."""

    archive: SystemArchive
    options: SystemOptions
    network: Network
    settings: Settings
    schedule: Schedule
    algorithm: str
    start: float
    step: float
    steps: int
    periods: dict[str, int]  # communication steps that one step of a component takes, where more than one

    @property
    def is_native(self) -> bool:
        return all(fmu.is_native for fmu in self.network.fmus.values())


def prepare_system(
    system: str | Path, options: SystemOptions | None = None, loaded: dict[str, Fmu] | None = None
) -> PreparedSystem:
    """Read and check a system with its options. Raises InputError.

    ``loaded`` keeps FMUs by their place, for a system that is prepared again and again: those in it are not read again.
    """
    with no_collection():
        return _prepared(system, options or SystemOptions(), {} if loaded is None else loaded)


def _prepared(system: str | Path, options: SystemOptions, loaded: dict[str, Fmu]) -> PreparedSystem:
    for name, value, known in (
        ("--algorithm", options.algorithm, ALGORITHMS),
        ("--flavour", options.flavour, FLAVOURS),
        ("--open-inputs", options.open_inputs, OPEN_INPUTS),
    ):
        if value is not None and value not in known:
            raise InputError(name, str(value), "unknown", suggestion(str(value), known))
    archive = open_system(system)
    description = read_description(archive, options.variant)

    used: dict[str, Component] = {}

    @cache
    def flavour_of(block: str) -> str:
        return options.flavour or ("native" if fmu_file(block, "native", archive.path) is not None else "python")

    def load(name: str, component: Component) -> Fmu:
        if name in options.use:
            used[name] = component
            read, label = locate_fmu(options.use[name], options.flavour, system=archive.path)
        else:
            flavour = flavour_of(Path(component.source).stem)
            read, label = archive.fmu(component.source, f"{name} (line {component.line})", flavour)
        if label not in loaded:
            loaded[label] = load_fmu(read(), label)
        return loaded[label]

    try:
        network = build_network(description, load)
    except InputError as error:
        slot = next((slot for slot in used if error.element.startswith(f"{slot}.")), None)
        if slot is None or error.file != description.file:
            raise
        raise unfit(slot, options.use[slot], used[slot], error) from error
    for slot in options.use:
        if slot not in network.fmus:
            raise InputError("--use", slot, "no such component", suggestion(slot, network.fmus))
    settings = collect_settings(network, archive, _assignments(archive, options), options)
    algorithm = options.algorithm or description.algorithm or ALGORITHMS[0]
    schedule = make_schedule(network, options.no_feedthrough, algorithm)
    start, step, steps = flight_times(network, options)
    periods = component_periods(network, options, step)
    check_samples(network, settings, step, periods)
    return PreparedSystem(archive, options, network, settings, schedule, algorithm, start, step, steps, periods)


def find_fmu(name: str, flavour: str | None, option: str = "--use") -> tuple[bytes, str]:
    """An FMU named by its block or by a path: its content and its name in messages. Raises InputError."""
    read, label = locate_fmu(name, flavour, option)
    return read(), label


def locate_fmu(
    name: str, flavour: str | None, option: str = "--use", system: Path | None = None
) -> tuple[Callable[[], bytes], str]:
    """Likewise, with what reads the content; ``system`` is where one's own are looked for, too."""
    if name.endswith(".fmu") or Path(name).name != name:
        path = Path(name)
        if not path.is_file():
            raise InputError(option, name, "no such file", "give a block's name or the path of an .fmu")
        return path.read_bytes, name
    for candidate in FLAVOURS if flavour is None else (flavour,):
        file = fmu_file(name, candidate, system)
        if file is not None:
            return file.read_bytes, str(file)
    raise InputError(option, name, "no such FMU is built", f"{suggestion(name, fmu_flavours())}; {HOW_TO_BUILD}")


def _assignments(archive: SystemArchive, options: SystemOptions) -> list[Assignment]:
    found: list[Assignment] = []
    for name in options.parameters:
        found += read_parameter_file(*archive.parameter_set(name))
    return found + [single_value(name, value, options.places.get(name)) for name, value in options.set.items()]


@contextmanager
def no_collection() -> Iterator[None]:
    """What is made inside has no cycles, and the collector would walk over all of it again and again."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
