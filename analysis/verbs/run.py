"""`perilune.simulate` and `perilune run`: a system, or an FMU alone, simulated once."""

from __future__ import annotations

import os
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from ...common.errors import InputError
from ...common.visible import on_one_line
from ..campaigns.definition.expressions import Expression
from ..campaigns.plain_text import faults_line
from ..documents.figures.declared import FigureDeclaration
from ..documents.figures.reading import read_figures
from ..documents.model import Document
from ..documents.of.simulation.figures.limits import limit_document
from ..documents.of.simulation.run import RunContext, run_document
from ..options.command import write_command
from ..options.declared.campaigns import RUN, RunOptions
from ..options.fault import Fault, faults_of
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight import results
from ..runtime.flight.interruptible import StuckError, fly
from ..runtime.flight.selection import find_variables
from ..runtime.instances.instance import Log
from ..runtime.process.opening import open_simulation
from ..runtime.system.inputs import missing_outputs
from ..runtime.system.options import system_options
from ..runtime.system.prepared import PreparedSystem, prepare_system
from ..runtime.system.series import read_series
from .common.arguments import read_requirements, requirement_problems
from .common.documented import Documented
from .common.flight_text import flight_lines, flight_problems, note_lines

if TYPE_CHECKING:  # plots and pages are imported where they are created: half of what a run without them would take
    from matplotlib.figure import Figure as Plot

    from ..documents.diagram.diagram import Diagram

STUCK = "nothing is written; see its messages with `log` all, or give a longer `timeout`"


@dataclass(repr=False, kw_only=True)
class Result(Documented, results.Result):
    """A simulation. ``result["plant.position"]`` is a signal over ``time``, [n] or [n, k]; see `Flight` for the rest.

    ``prepared`` is the system as it was simulated, ``figures`` those that its SSD declares, which `report` plots;
    ``faults`` were injected, ``requirements`` are those of the option ``require``; ``command`` simulates it again, with
    the same input over time unless that was an array.
    """

    prepared: PreparedSystem
    figures: tuple[FigureDeclaration, ...]
    faults: tuple[Fault | str, ...] = ()
    requirements: tuple[Expression, ...] = ()
    command: str = ""

    @property
    def system(self) -> str:
        """The system's name."""
        return self.prepared.archive.name

    def document(self) -> Document:
        """Return the simulation as a document."""
        return run_document(self, self.context(), self.to_json())

    def context(self) -> RunContext:
        """Return the system and the command behind the document."""
        faults = [faults_line(self.faults)] if self.faults else []
        notes = [*note_lines(self.prepared), *([] if self.signals else missing_outputs(self.prepared.network))]
        lines = [*flight_lines(self.prepared, self.figures, self), *notes, *faults]
        return RunContext(
            title=self.system,
            figures=self.figures,
            draw_diagram=self._diagram,
            command=self.command,
            lines=[on_one_line(line) for line in lines],
        )

    def _diagram(self) -> Diagram:
        from ..documents.diagram.diagram import make_diagram

        return make_diagram(self.prepared, faults_of(self.faults))

    def plot(self, *names: str) -> Plot:
        """Plot signals over time, a panel for each name; a vector's elements share one.

        Raises KeyError for an unknown name, InputError without any.
        """
        from ..documents.of.simulation.histories import signal_plot

        if not names:
            displayed = ", ".join(list(self.signals)[:3])
            remedy = f"give one or more of `signals`: {displayed}, ..."
            raise InputError("plot", "", "no signal is named", remedy)
        return signal_plot(self, names)

    def plot_trajectory(self) -> Plot:
        """Plot the path of each position: ground track and side view. Raises ValueError where there is none."""
        from ..documents.of.simulation.trajectory import trajectory_plot

        plot = trajectory_plot(self)
        if plot is None:
            raise ValueError(f"{self.system}: no signal COMPONENT.position of three elements in m; plot others by name")
        return plot

    @property
    def limits(self) -> list[dict[str, Any]]:
        """The SSD's `Limits`, evaluated at the end: name, value, unit, least, most and verdict of each.

        The verdict is ``met``, ``violated`` or ``not evaluated``, with the reason why not.
        """
        return limit_document(self.figures, self)

    def to_json(self) -> dict[str, object]:
        """Return status, provenance, limits and final values, for other programs."""
        final = {name: value if abs(value) < float("inf") else None for name, value in self.final().items()}
        return self.summary() | {"limits": self.limits, "final": final}

    def problems(self) -> list[str]:
        """Return the reason for an incomplete simulation, violated limits, and requirements that are not met."""
        problems = flight_problems(self.prepared, self.figures, self)
        return problems + requirement_problems(self.requirements, self.last_values())

    def last_values(self) -> dict[str, float]:
        """Return the last values of signals and of time, for requirements."""
        if not self.time.size:
            return {}
        return {"time": float(self.time[-1]), **{name: float(value) for name, value in self.final().items()}}


@verb(RUN)
def simulate(system: FilePath, **options: Unpack[RunOptions]) -> Result:
    """Simulate a system, or an FMU alone, once: `perilune run`.

    ``system`` is a name under ssp_systems, a folder, an .ssp or .fmu; ``use`` maps components to FMUs (block names or
    paths), ``parameters`` lists parameter sets (names of the system's, or paths), ``set`` maps ``component.variable``
    to values in SI units, and ``component.vector`` to lists of them; ``faults`` are `Fault` or their texts; ``step``
    and ``stop_time`` are in s. ``input`` are inputs over time: the path of a CSV file, a structured array or columns by
    name, ``time`` (s) and unconnected inputs. ``record`` names further variables to record, such as local ones,
    ``component.vector`` all its elements; of an FMU alone without the component. ``log`` writes FMU messages from this
    level on to standard error; ``timeout`` (s, wall clock) ends the simulation at its next communication point;
    ``require`` are expressions over the last values, see `Result.problems`. Raises InputError, and TimeoutError where a
    step of an FMU does not return; a simulation that fails comes back with its ``status``.
    """
    series = None if options["input"] is None else read_series(options["input"])
    prepared = prepare_system(os.fspath(system), system_options(options), series=series)
    figures, faults, level = tuple(read_figures(prepared)), faults_of(options["faults"]), options["log"]
    log = None if level is None else Log(level)
    more = find_variables(prepared.network, options["record"], is_alone=prepared.archive.is_fmu)
    with (
        chdir(Path.cwd()),
        open_simulation(prepared, faults=faults, log=log, more=more) as simulation,
    ):  # an FMU may change the folder
        requirements = read_requirements(options["require"], [*simulation.signal_names, "time"])
        try:
            flight = fly(simulation, options["timeout"])
        except StuckError as error:
            raise StuckError(f"{prepared.network.file}: {error}; {STUCK}") from error
    file = series.file if series is not None and series.lines else None
    texts = {**options, "faults": [str(each) for each in faults], "input": file}
    return Result.extending(
        flight,
        prepared=prepared,
        figures=figures,
        faults=tuple(faults),
        requirements=tuple(requirements),
        command=write_command(RUN, {"system": system}, texts),
    )
