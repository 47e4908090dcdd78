"""`perilune.simulate` and `perilune run`: one simulation of a system, or of an FMU alone."""

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
from ..documents.figures.figure_reader import read_figures
from ..documents.model import Document
from ..documents.of.simulation.ending import flight_lines, flight_problems, note_lines
from ..documents.of.simulation.figures.limits import limit_document
from ..documents.of.simulation.run import RunContext, run_document
from ..documents.of.unmet import requirement_problems
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
from .common.arguments import read_requirements
from .common.documented import Documented

if TYPE_CHECKING:  # imported where needed: they take as long as a run without them
    from matplotlib.figure import Figure as Plot

    from ..documents.diagram.diagram import BlockDiagram

STUCK = "no file was written; see the FMU's messages with `log` all, or give a longer `timeout`"


@dataclass(repr=False, kw_only=True)
class Result(Documented, results.FlightResult):
    """Result of a simulation: ``result["plant.position"]`` is a signal over ``time``, [n] or [n, k]; see `Flight`.

    - ``prepared``: the simulated system.
    - ``figures``: figures that its SSD declares for `report`.
    - ``faults``: injected faults.
    - ``requirements``: expressions of the option ``require``.
    - ``command``: command that repeats the simulation, with its input over time unless that was an array.
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
        """Return the context of the document: system and command."""
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

    def _diagram(self) -> BlockDiagram:
        from ..documents.diagram.diagram import make_diagram

        return make_diagram(self.prepared, faults_of(self.faults))

    def plot(self, *names: str) -> Plot:
        """Plot signals over time, a panel for each name; the elements of a vector share one panel.

        Raises KeyError for an unknown name, InputError without a name.
        """
        from ..documents.of.simulation.histories import signal_plot

        if not names:
            displayed = ", ".join(list(self.signals)[:3])
            remedy = f"give one or more of `signals`: {displayed}, ..."
            raise InputError("plot", "", "no signal is named", remedy)
        return signal_plot(self, names)

    def plot_trajectory(self) -> Plot:
        """Plot the trajectory of each position: ground track and side view. Raises ValueError without a position."""
        from ..documents.of.simulation.trajectory import trajectory_plot

        plot = trajectory_plot(self)
        if plot is None:
            raise ValueError(
                f"{self.system}: no signal COMPONENT.position has three elements in m; plot other signals by name"
            )
        return plot

    @property
    def limits(self) -> list[dict[str, Any]]:
        """The SSD's `LimitsFigure` evaluated at the end: name, value, unit, least, most and verdict of each.

        The verdict is ``met``, ``violated`` or ``not evaluated``; the latter includes the reason.
        """
        return limit_document(self.figures, self)

    def to_json(self) -> dict[str, object]:
        """Return status, provenance, limits and final values as JSON values, for other programs."""
        final = {name: value if abs(value) < float("inf") else None for name, value in self.final().items()}
        return self.summary() | {"limits": self.limits, "final": final}

    def problems(self) -> list[str]:
        """Return a line for an incomplete simulation, violated limits, and each requirement that is not met."""
        problems = flight_problems(self.prepared, self.figures, self)
        return problems + requirement_problems(self.requirements, self.last_values())

    def last_values(self) -> dict[str, float]:
        """Return the last values of time and signals, for requirements."""
        if not self.time.size:
            return {}
        return {"time": float(self.time[-1]), **{name: float(value) for name, value in self.final().items()}}


@verb(RUN)
def simulate(system: FilePath, **options: Unpack[RunOptions]) -> Result:
    """Simulate a system, or an FMU alone, once: `perilune run`.

    ``use`` maps components to FMUs (block names or paths); ``parameters`` are names of the system's parameter sets, or
    paths; ``set`` maps ``component.variable`` to values in SI units, and ``component.vector`` to lists; ``faults`` are
    `Fault` or their texts. ``input`` is the path of a CSV file, a structured array, or columns by name: ``time`` (s)
    and unconnected inputs. ``record`` names further variables to record; ``component.vector`` stands for all elements,
    and names of an FMU alone have no component. ``timeout`` (s, wall clock) ends the simulation at its next
    communication point. ``require`` lists expressions over the last values; see `Result.problems`.

    Raises InputError, and TimeoutError if a step of an FMU does not return. A simulation that fails returns a result
    with its ``status``.
    """
    series = None if options["input"] is None else read_series(options["input"])
    prepared = prepare_system(os.fspath(system), system_options(options), series=series)
    figures, faults, level = tuple(read_figures(prepared)), faults_of(options["faults"]), options["log"]
    log = None if level is None else Log(level)
    more = find_variables(prepared.network, options["record"], is_alone=prepared.archive.is_fmu)
    with (
        chdir(Path.cwd()),
        open_simulation(prepared, faults=faults, log=log, additional=more) as simulation,
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
