"""Prepared systems: files read, FMUs loaded, everything checked before the first step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import chdir
from dataclasses import dataclass, field, replace
from pathlib import Path

from ....common.collection import no_collection
from ....common.errors import InputError, suggestion
from ...options.choices import SEQUENTIAL
from ..ssp.archive import SystemArchive, open_system, read_fmu
from ..ssp.ssd_reader import read_description
from ..ssp.system_description import SystemElement
from .alone import describe_alone
from .arrays.axis_names import read_frames
from .arrays.crosswise import crosswise_notes
from .arrays.elements import expand_arrays
from .assignments import collect_settings
from .checks import check_aliases, check_samples, check_shared
from .component_fmus import ComponentFmus
from .feedthrough import find_feedthrough
from .flattening import build_network
from .fmu import Fmu
from .inputs import Drive, check_signals, drive_inputs, find_driven, settle_open_inputs
from .namesakes.namesakes import check_namesakes
from .network import Network
from .options import SystemOptions
from .passing.settings import SystemSettings
from .schedule import Schedule, make_schedule
from .series import InputSeries
from .times import component_periods, flight_times


@dataclass
class PreparedSystem:
    """Checked system, ready for `Simulation`. Times are in s.

    ``remarks`` state defaults that were used for a stand-alone FMU. ``drive`` contains the inputs over time, if there
    are any. ``elsewhere`` contains functions that read the files outside the system, by the keys of
    `SystemArchive.elsewhere`. ``retired`` contains notes on FMUs with retired names.
    """

    archive: SystemArchive
    options: SystemOptions
    network: Network
    settings: SystemSettings
    schedule: Schedule
    algorithm: str
    start: float
    step: float
    steps: int
    periods: dict[str, int]  # communication steps in one step of a component, by component, if more than one
    remarks: tuple[str, ...] = ()
    drive: Drive | None = None
    elsewhere: Mapping[str, Callable[[], bytes]] = field(default_factory=dict)
    retired: tuple[str, ...] = ()

    @property
    def assumptions(self) -> list[str]:
        """Assumptions about undeclared dependencies, a line for each component with its FMU."""
        return self.schedule.feedthrough.notes(self.network, self.algorithm)

    @property
    def is_self_contained(self) -> bool:
        """True if all of its FMUs are self-contained; see `Fmu`."""
        return all(fmu.is_self_contained for fmu in self.network.fmus.values())

    @property
    def printers(self) -> list[str]:
        """Components that may print in a child process.

        These are foreign FMUs and FMUs with external state or, if there are none, all components.
        """
        fmus = self.network.fmus
        return [name for name, fmu in fmus.items() if not fmu.is_self_contained] or list(fmus)

    def of_flights(self) -> PreparedSystem:
        """Return the system reduced to the data for simulations, which can be sent to another process.

        Documents and functions are removed.
        """
        description = self.network.description
        root = SystemElement(description.system.name, {}, [], description.system.line)
        network = replace(self.network, description=replace(description, system=root, annotations={}), systems={})
        return replace(self, network=network, options=SystemOptions(folder=self.options.folder), elsewhere={})

    @property
    def is_native(self) -> bool:
        return all(fmu.is_native for fmu in self.network.fmus.values())

    @property
    def has_fmi3(self) -> bool:
        """True if one of its FMUs is of FMI 3.0."""
        return any(fmu.version == 3 for fmu in self.network.fmus.values())

    @property
    def is_alone(self) -> bool:
        """True if a process cannot have two simulations of it, since one of its FMUs allows no second instance."""
        return any(fmu.is_alone for fmu in self.network.fmus.values())

    @property
    def flies_in_threads(self) -> bool:
        """True if several threads of a process can simulate it in parallel, which then saves time."""
        return self.is_native and not self.is_alone


def prepare_system(
    system: str | Path | SystemArchive,
    options: SystemOptions | None = None,
    loaded: dict[str, Fmu] | None = None,
    series: InputSeries | None = None,
) -> PreparedSystem:
    """Read and check a system with its options, and with inputs over time if there are any. Raises InputError.

    ``loaded`` caches FMUs by label, so that they are read only once if a system is prepared repeatedly.
    """
    options = options or SystemOptions()
    with no_collection(), chdir(options.folder):
        return _prepare(system, options, {} if loaded is None else loaded, series)


def _prepare(
    system: str | Path | SystemArchive, options: SystemOptions, loaded: dict[str, Fmu], series: InputSeries | None
) -> PreparedSystem:
    archive = system if isinstance(system, SystemArchive) else open_system(system)
    fmus = ComponentFmus(archive, options, loaded)
    network, remarks = _read_network(fmus)
    if series is not None:
        network.driven = find_driven(network, series, next(iter(network.fmus)) if archive.is_fmu else None)
    settings = _check_settings(network, fmus)
    algorithm = options.chosen["algorithm"] or fmus.description.algorithm or SEQUENTIAL
    feedthrough = find_feedthrough(network, options, algorithm, is_alone=archive.is_fmu)
    schedule = make_schedule(network, feedthrough, algorithm)
    network.notes += schedule.feedthrough.notes(network, algorithm)
    start, step, steps = flight_times(network, options)
    periods = component_periods(network, options, step)
    check_samples(network, settings, step, periods)
    return PreparedSystem(
        archive=archive,
        options=options,
        network=network,
        settings=settings,
        schedule=schedule,
        algorithm=algorithm,
        start=start,
        step=step,
        steps=steps,
        periods=periods,
        remarks=tuple(remarks),
        drive=None if series is None else drive_inputs(network, series, network.driven, start, step, steps),
        elsewhere=fmus.elsewhere,
        retired=tuple(retired.note(name, old) for name, (old, retired) in fmus.retired.items()),
    )


def _read_network(fmus: ComponentFmus) -> tuple[Network, list[str]]:
    """Return the network of a system with its FMUs loaded, and remarks on a stand-alone FMU. Raises InputError."""
    archive, options = fmus.archive, fmus.options
    remarks: list[str] = []
    if archive.is_fmu:
        alone = fmus.open(read_fmu(archive.path), archive.label)
        fmus.description, remarks = describe_alone(alone, options)
        sized = fmus.with_sizes(alone, next(iter(fmus.description.system.elements)))
        fmus.description, remarks = describe_alone(sized, options)
    else:
        fmus.description = read_description(archive, options.chosen["variant"])
    try:
        fmus.description = expand_arrays(fmus.description, fmus.sizes)
        network = build_network(fmus.description, fmus.load)
    except InputError as error:
        fmus.refuse_unfit(error)
        raise
    network.notes += [*remarks, *(f"{fmus.description.file}: {note}" for note in fmus.description.notes)]
    for slot in options.use:
        if slot not in network.fmus:
            raise InputError("`use`", slot, "no such component", suggestion(slot, network.fmus))
    read_frames(network, options.use)
    _refuse_seconds(network)
    check_namesakes(network.fmus.values(), in_process=options.trust["in_process"])
    return network, remarks


def _check_settings(network: Network, fmus: ComponentFmus) -> SystemSettings:
    """Return the settings of a network, after checking the network with them. Raises InputError."""
    archive, options = fmus.archive, fmus.options
    assignments = [each for name, (_, retired) in fmus.retired.items() for each in retired.assignments(name)]
    assignments += fmus.assignments
    network.notes += fmus.notes
    settings = collect_settings(network, archive, assignments, options)
    keep_starts = archive.is_fmu if options.chosen["open_inputs"] is None else options.chosen["open_inputs"] == "start"
    settle_open_inputs(network, settings, keep_starts=keep_starts)
    check_signals(network, settings)
    check_shared(network, settings)
    check_aliases(network)
    for fmu in {fmu.label: fmu for fmu in network.fmus.values()}.values():
        network.notes.extend(f"{fmu.label}: modelDescription.xml: {flaw}" for flaw in fmu.flaws)
    network.notes += [*filter(None, [archive.note()]), *crosswise_notes(network)]
    return settings


def _refuse_seconds(network: Network) -> None:
    """Reject an FMU that is used by two components if a process can have only one instance of it."""
    first: dict[str, str] = {}
    for name, fmu in network.fmus.items():
        if fmu.is_alone and fmu.digest in first:
            problem = f"{fmu.label} can be instantiated only once in a process (canBeInstantiatedOnlyOncePerProcess)"
            remedy = "remove one of the components, or export the FMU for several instances"
            raise InputError(network.file, f"{first[fmu.digest]}, {name}", problem, remedy)
        first.setdefault(fmu.digest, name)
