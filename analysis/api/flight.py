"""One flight from Python: `simulate`, and its result with page, plots and what a notebook shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from matplotlib.figure import Figure as Plot

from ..reports.figures.declaration.declared import Figure
from ..reports.figures.declaration.histories import Band
from ..reports.figures.declaration.reading import read_figures
from ..reports.figures.declaration.stages import Limits
from ..reports.figures.limit_table import limit_document, limit_rows
from ..reports.flight.plots import signal_plot
from ..reports.flight.run_report import key_values, write_run_report
from ..reports.flight.trajectory import trajectory_plot
from ..runtime.flight import results
from ..runtime.flight.instances.log import Log
from ..runtime.flight.interruptible import fly
from ..runtime.flight.simulation import Simulation
from ..runtime.ssp.parameter_sets import SetValue
from ..runtime.system.fault import Fault, faults_of
from ..runtime.system.in_flight.series import Given, read_series
from ..runtime.system.in_flight.watch import Watch
from ..runtime.system.prepared import prepare_system
from .notebook import Grid, notebook_view, value_text
from .options import FilePath, check_list, system_options

MOST_PLOTTED = 3  # signals of a flight without a path, in a notebook


@dataclass(repr=False)
class Result(results.Result):
    """A flight. ``result["plant.position"]`` is a signal over ``time``, [n] or [n, k]; see `Flight` for the rest.

    ``system`` is the system's name, ``figures`` what its SSD asks for, which `report` draws.
    """

    system: str
    figures: tuple[Figure, ...]

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune run --report`: one HTML file."""
        write_run_report(self, Path(path), self.system, self.figures)

    def plot(self, name: str, *more: str) -> Plot:
        """Signals over time, a panel for each name; a vector's elements are together. Raises KeyError."""
        return signal_plot(self, [name, *more])

    def plot_trajectory(self) -> Plot:
        """The path of whatever has a position: plan and side view. Raises ValueError where nothing has one."""
        plot = trajectory_plot(self)
        if plot is None:
            raise ValueError(f"{self.system}: no signal COMPONENT.position of three elements in m; plot others by name")
        return plot

    @property
    def limits(self) -> list[dict[str, Any]]:
        """What the SSD's `Limits` say of the end: name, value, unit, least, most and verdict of each.

        The verdict is ``kept``, ``not kept`` or ``not evaluated``, with the reason why not.
        """
        return limit_document(self.figures, self)

    def _repr_html_(self) -> str:
        end = f" at t = {self.time[-1]:g} s" if self.time.size else ""
        words = f"{self.status}{end}, {self.time.size} rows, {len(self.signals)} signals"
        grids = [
            Grid((figure.title, "value", "limit", "unit", ""), limit_rows(figure, self))
            for figure in self.figures
            if isinstance(figure, Limits)
        ]
        if not grids:
            rows = [(row["label"], row["note"], value_text(row["values"], row["unit"])) for row in key_values(self)]
            grids = [Grid(("", "", "at the end"), rows)]
        return notebook_view(self.system, [words, self.message], grids, self._main_plot())

    def _main_plot(self) -> Plot | None:
        if not self.time.size:
            return None
        asked = [figure.signal.label for figure in self.figures if isinstance(figure, Band)]
        vectors = [row["label"] for row in key_values(self) if len(row["values"]) > 1]
        return trajectory_plot(self) or signal_plot(self, (asked or vectors or list(self.signals))[:MOST_PLOTTED])


def simulate(
    system: FilePath,
    *,
    use: Mapping[str, FilePath] | None = None,
    parameters: Sequence[FilePath] = (),
    set: Mapping[str, SetValue] | None = None,
    faults: Sequence[Fault | str] = (),
    input: Given | None = None,
    log: Literal["error", "warning", "info", "all"] | None = None,
    timeout: float | None = None,
    step: float | None = None,
    stop_time: float | None = None,
    algorithm: Literal["sequential", "jacobi"] | None = None,
    variant: str | None = None,
    flavour: Literal["native", "python"] | None = None,
    allow_unmatched: bool = False,
    strict: bool = False,
    open_inputs: Literal["refuse", "start"] = "refuse",
    feedthrough: Sequence[str] = (),
    no_feedthrough: Sequence[str] = (),
) -> Result:
    """Fly a system, or an FMU alone, once: `perilune run`.

    ``system`` is a name under ssp_systems, a folder, an .ssp or .fmu; ``use`` maps components to FMUs (block names or
    paths), ``parameters`` lists parameter sets (names of the system's, or paths), ``set`` maps ``component.variable``
    to values in SI units, and ``component.vector`` to lists of them; ``faults`` are `Fault` or texts as --fault takes
    them; ``step`` and ``stop_time`` are in s. ``input`` are inputs over time: the path of a CSV file,
    a structured array or columns by name, ``time`` (s) and inputs that nothing is connected to. ``log``
    writes what FMUs say to standard error, from this level on; ``timeout`` (s, wall clock) ends the flight at its next
    communication point. Raises InputError, and TimeoutError where a step of an FMU does not return; a flight that
    fails comes back with its ``status``.
    """
    options = system_options(
        use, parameters, set, feedthrough, no_feedthrough, step=step, stop_time=stop_time, algorithm=algorithm,
        variant=variant, flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
    )  # fmt: skip
    check_list("faults", faults)
    given = faults_of(faults)
    prepared = prepare_system(Path(system), options, series=None if input is None else read_series(input))
    figures = tuple(read_figures(prepared))
    watch, lines = Watch(timeout, log), None if log is None else Log(log)
    with chdir(Path.cwd()), Simulation(prepared, faults=given, log=lines) as simulation:  # an FMU may change the folder
        return Result(**vars(fly(simulation, watch.timeout)), system=prepared.archive.name, figures=figures)
