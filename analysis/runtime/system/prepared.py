"""A system made ready: its files read, its FMUs loaded, everything checked before the first step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import chdir
from dataclasses import dataclass, field, replace
from functools import cache, partial
from pathlib import Path

from ....common.collection import no_collection
from ....common.errors import InputError, suggestion
from ....common.paths import FLAVOURS, names_fmu
from ....common.regular import names_file
from ....fmus_src.export.available import find_fmu, fmu_flavours
from ..fmi.structure import structural_sizes
from ..ssp.archive import HOW_TO_BUILD, SystemArchive, fmu_asked, open_system, parameters_asked, read_fmu, use_asked
from ..ssp.description import Component, System
from ..ssp.parameter_sets import Assignment, read_parameter_file
from ..ssp.reading import read_description
from .alone import describe_alone
from .arrays.crosswise import crosswise_notes
from .arrays.elements import expand_arrays
from .arrays.sizes import Sizes, given_values
from .assignments import collect_settings, single_value
from .checks import check_aliases, check_samples, check_shared, missing_fmu, unfit
from .feedthrough import find_feedthrough
from .flattening import build_network
from .fmu import Fmu, load_fmu
from .inputs import Drive, check_signals, drive_inputs, find_driven, settle_open_inputs
from .namesakes.namesakes import check_namesakes
from .network import Network
from .options import ALGORITHMS, FUSED, OPEN_INPUTS, SystemOptions
from .passing.settings import Settings
from .schedule import Schedule, make_schedule
from .series import InputSeries
from .stale import Retired, find_retired
from .times import component_periods, flight_times


@dataclass
class PreparedSystem:
    """A checked system; pass it to `Simulation`. Times in s; ``remarks`` say what an FMU alone left open.

    ``drive`` are its inputs over time, if it has them; ``elsewhere`` reads the files that are not the system's own, by
    the names of `SystemArchive.elsewhere`. ``retired`` are notes on FMUs whose names are no longer to be used.
    """

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
    remarks: tuple[str, ...] = ()
    drive: Drive | None = None
    elsewhere: Mapping[str, Callable[[], bytes]] = field(default_factory=dict)
    retired: tuple[str, ...] = ()

    @property
    def assumptions(self) -> list[str]:
        """What was assumed since an FMU does not declare it, each in a line that names the component and its FMU."""
        return self.schedule.feedthrough.notes(self.network, self.algorithm)

    @property
    def is_self_contained(self) -> bool:
        """Whether all of its FMUs are; see `Fmu`."""
        return all(fmu.is_self_contained for fmu in self.network.fmus.values())

    @property
    def printers(self) -> list[str]:
        """The components that may print where they simulate apart: those of others, of external state, else all."""
        fmus = self.network.fmus
        return [name for name, fmu in fmus.items() if not fmu.is_self_contained] or list(fmus)

    def of_flights(self) -> PreparedSystem:
        """What flights take of it, and another process can be sent: without documents, and readers of files."""
        description = self.network.description
        root = System(description.system.name, {}, [], description.system.line)
        network = replace(self.network, description=replace(description, system=root, annotations={}), systems={})
        return replace(self, network=network, options=SystemOptions(folder=self.options.folder), elsewhere={})

    @property
    def is_native(self) -> bool:
        return all(fmu.is_native for fmu in self.network.fmus.values())

    @property
    def has_fmi3(self) -> bool:
        """Whether one of its FMUs is of FMI 3.0."""
        return any(fmu.version == 3 for fmu in self.network.fmus.values())

    @property
    def is_alone(self) -> bool:
        """Whether a process can fly it once at a time only, since an FMU of it allows no second instance."""
        return any(fmu.is_alone for fmu in self.network.fmus.values())

    @property
    def flies_in_threads(self) -> bool:
        """Whether several threads of a process can fly it side by side, and gain by it."""
        return self.is_native and not self.is_alone


def prepare_system(
    system: str | Path | SystemArchive,
    options: SystemOptions | None = None,
    loaded: dict[str, Fmu] | None = None,
    series: InputSeries | None = None,
) -> PreparedSystem:
    """Read and check a system with its options, and with inputs over time if it is to have them. Raises InputError.

    ``loaded`` keeps FMUs by their place, for a system that is prepared again and again: those in it are not read again.
    """
    options = options or SystemOptions()
    with no_collection(), chdir(options.folder):
        return _prepare(system, options, {} if loaded is None else loaded, series)


def _prepare(
    system: str | Path | SystemArchive, options: SystemOptions, loaded: dict[str, Fmu], series: InputSeries | None
) -> PreparedSystem:
    for name, value, known in (
        ("`algorithm`", options.algorithm, ALGORITHMS),
        ("`flavour`", options.flavour, (*FLAVOURS, FUSED)),
        ("`open_inputs`", options.open_inputs, OPEN_INPUTS),
    ):
        if value is not None and value not in known:
            raise InputError(name, str(value), "unknown", suggestion(str(value), known))
    archive = system if isinstance(system, SystemArchive) else open_system(system)
    elsewhere: dict[str, Callable[[], bytes]] = {}

    used: dict[str, Component] = {}

    replaced: dict[str, tuple[str, Retired]] = {}  # by component: the name asked for, and what replaces it

    def current(component: str, name: str) -> str:
        retired = find_retired(name, archive.path)
        if retired is None:
            return name
        replaced[component] = name, retired
        return retired.block

    def load(name: str, component: Component) -> Fmu:
        if name in options.use:
            used[name] = component
            key = use_asked(options.use[name])
            block = current(name, options.use[name])
            if key in archive.elsewhere:
                read, label = read_fmu(archive.elsewhere[key]), options.use[name]
            else:
                archive.refuse_elsewhere(options.use[name], f"`use` {name}")
                if is_missing(block, options.build, archive.path):
                    raise missing_fmu(name, block, component)
                read, label = locate_fmu(block, options.build, system=archive.path)
            elsewhere[key] = read
        else:
            source = component.source
            if not (archive.is_own_file(source) or fmu_asked(source) in archive.elsewhere):
                source = Path(source).with_stem(current(name, Path(source).stem)).as_posix()
            read, label = archive.fmu(source, f"{name} (line {component.line})", options.build)
            if not archive.is_own_file(source):
                elsewhere[fmu_asked(source)] = read
        return sized(open_fmu(read, label), name)

    notes: list[str] = []

    @cache
    def chosen() -> list[Assignment]:
        return _assignments(notes, archive, options, elsewhere)

    def sized(fmu: Fmu, name: str) -> Fmu:
        if not fmu.structural_parameters:
            return fmu
        names = fmu.structural_parameters
        given = structural_sizes(description, archive, name, names, chosen())
        return fmu.with_sizes(given | sizes().connected(name, names))

    @cache
    def sizes() -> Sizes:
        return Sizes(description, lambda: given_values(description, archive, chosen()), load)

    def open_fmu(read: Callable[[], bytes], label: str) -> Fmu:
        if label not in loaded:
            loaded[label] = load_fmu(read(), label, strict=options.strict)
        return loaded[label]

    remarks: list[str] = []
    if archive.is_fmu:
        alone = open_fmu(read_fmu(archive.path), archive.label)
        description, remarks = describe_alone(alone, options)
        description, remarks = describe_alone(sized(alone, next(iter(description.system.elements))), options)
    else:
        description = read_description(archive, options.variant)
    try:
        description = expand_arrays(description, sizes())
        network = build_network(description, load)
    except InputError as error:
        slot = next((slot for slot in used if error.element.startswith(f"{slot}.")), None)
        if slot is None or error.file != description.file:
            raise
        raise unfit(slot, options.use[slot], used[slot], error) from error
    network.notes += [*remarks, *(f"{description.file}: {note}" for note in description.notes)]
    for slot in options.use:
        if slot not in network.fmus:
            raise InputError("`use`", slot, "no such component", suggestion(slot, network.fmus))
    _refuse_seconds(network)
    check_namesakes(network.fmus.values(), in_process=options.in_process)
    if series is not None:
        network.driven = find_driven(network, series, next(iter(network.fmus)) if archive.is_fmu else None)
    assignments = [each for name, (_, retired) in replaced.items() for each in retired.assignments(name)]
    assignments += chosen()
    network.notes += notes
    settings = collect_settings(network, archive, assignments, options)
    keep_starts = archive.is_fmu if options.open_inputs is None else options.open_inputs == "start"
    settle_open_inputs(network, settings, keep_starts=keep_starts)
    check_signals(network, settings)
    check_shared(network, settings)
    check_aliases(network)
    for fmu in {fmu.label: fmu for fmu in network.fmus.values()}.values():
        network.notes.extend(f"{fmu.label}: modelDescription.xml: {flaw}" for flaw in fmu.flaws)
    network.notes += [*filter(None, [archive.note()]), *crosswise_notes(network)]
    algorithm = options.algorithm or description.algorithm or ALGORITHMS[0]
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
        elsewhere=elsewhere,
        retired=tuple(retired.note(name, old) for name, (old, retired) in replaced.items()),
    )


def _refuse_seconds(network: Network) -> None:
    """Refuse an FMU in two components where a process can hold one instance of it only."""
    first: dict[str, str] = {}
    for name, fmu in network.fmus.items():
        if fmu.is_alone and fmu.digest in first:
            problem = f"{fmu.label} can be instantiated only once in a process (canBeInstantiatedOnlyOncePerProcess)"
            remedy = "take one of them out, or export the FMU for more instances"
            raise InputError(network.file, f"{first[fmu.digest]}, {name}", problem, remedy)
        first.setdefault(fmu.digest, name)


def is_missing(name: str, flavour: str | None, system: Path | None) -> bool:
    """True of a name by which no FMU is built; not of paths."""
    return Path(name).name == name and not names_fmu(name) and find_fmu(name, _flavours(flavour), system) is None


def _flavours(flavour: str | None) -> tuple[str, ...]:
    return FLAVOURS if flavour is None else (flavour,)


def locate_fmu(
    name: str, flavour: str | None, option: str = "`use`", system: Path | None = None
) -> tuple[Callable[[], bytes], str]:
    """Likewise, with what reads the content; ``system`` is where one's own are looked for, too."""
    if names_fmu(name) or Path(name).name != name:
        path = Path(name)
        if not names_file(path):
            raise InputError(option, name, "no such file", "give a block's name or the path of an .fmu")
        return read_fmu(path), name
    file = find_fmu(name, _flavours(flavour), system)
    if file is not None:
        return read_fmu(file), str(file)
    raise InputError(option, name, "no such FMU is built", f"{suggestion(name, fmu_flavours())}; {HOW_TO_BUILD}")


def _assignments(
    notes: list[str], archive: SystemArchive, options: SystemOptions, elsewhere: dict[str, Callable[[], bytes]]
) -> list[Assignment]:
    assignments: list[Assignment] = []
    for name in options.parameters:
        data, label = archive.parameter_set(name)
        if not label.startswith(f"{archive.label}!"):
            elsewhere[parameters_asked(name)] = partial(bytes, data)
        assignments += read_parameter_file(data, label, notes if options.allow_unmatched else None, notes)
    return assignments + [single_value(name, value, options.places.get(name)) for name, value in options.set.items()]
