"""`perilune.stability`: a stability study; its result with page, diagrams and tables."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from ...common.errors import suggestion
from ..commands.stability import study_command
from ..documents.model import Document
from ..documents.of.stability.figures import SIZE, LoopDiagram, loop_charts
from ..documents.of.stability.printed import stability_problems
from ..documents.of.stability.study_document import decisive_loop, stability_document
from ..options.command import write_command
from ..options.declared.studies import STABILITY, StabilityOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.flight.results import require_pandas
from ..runtime.system.options import system_options
from ..stability.request.request import read_request
from ..stability.results import report
from ..stability.results.data import write_data
from ..stability.results.document import KEYS
from ..stability.results.report import LoopReport
from ..stability.study import study
from .common.documented import Documented

if TYPE_CHECKING:  # imported where needed: matplotlib is slow to import
    from matplotlib.figure import Figure as Plot


@dataclass(repr=False)
class StabilityReport(Documented, report.StabilityStudy):
    """Result of a stability study: ``loops``, ``points``, ``sweeps``, ``joint`` and a ``verdict``.

    Gains are factors, angles are in rad; ``command`` repeats the study.
    """

    command: str = ""

    def __repr__(self) -> str:
        verdicts = ", ".join(f"{loop.name} at {loop.point}: {loop.verdict}" for loop in self.loops)
        return f"{type(self).__name__}({self.system}: {self.verdict}; {verdicts})"

    def loop(self, name: str, point: str | None = None) -> LoopReport:
        """Return a loop by name; ``point`` is needed if it is studied at several operating points. Raises KeyError."""
        named = {loop.point: loop for loop in self.loops if loop.name == name}
        if not named:
            raise KeyError(f"no loop {name}; {suggestion(name, {loop.name for loop in self.loops})}")
        if point is None and len(named) > 1:
            raise KeyError(f"{name} is studied at several points; {suggestion('', named)}")
        if point is not None and point not in named:
            raise KeyError(f"{name} is not studied at {point}; {suggestion(point, named)}")
        return next(iter(named.values())) if point is None else named[point]

    def document(self) -> Document:
        """Return a document with verdict, margins, operating points and loops."""
        return stability_document(self, self.command)

    def problems(self) -> list[str]:
        """Return a line for each requirement not met or withheld, and for each loop that could not be studied."""
        return stability_problems(self)

    def to_pandas(self) -> Any:
        """Return margins as a pandas.DataFrame, a row per loop and operating point, in dB, deg and s; needs pandas.

        Margins of an unstable loop are NaN; a margin without a crossing is infinite.
        """
        require_pandas()
        from pandas import DataFrame

        rows = [
            {"loop": loop.name, "point": loop.point, "stable": loop.stable, "verdict": str(loop.verdict)}
            | {key: float("nan") if loop.margins.unstable else loop.margins.size(kind) for key, kind in KEYS.items()}
            | {"delay_margin_s": float("nan") if loop.margins.unstable else loop.classical.delay_margin}
            for loop in self.loops
        ]
        return DataFrame(rows).set_index(["loop", "point"])

    def write_data(self, folder: FilePath) -> None:
        """Write the files of `perilune stability --data`: responses and A, B, C, D for python-control and MATLAB."""
        write_data(self, Path(folder))

    def plot_bode(self, loop: str | None = None, point: str | None = None) -> Plot:
        """Plot gain and phase of a loop over frequency; by default of the first loop that fails, else of the first.

        All diagrams raise KeyError for an unknown loop, ValueError if the study lacks the data of the diagram.
        """
        return self._plot(LoopDiagram.BODE, loop, point)

    def plot_nyquist(self, loop: str | None = None, point: str | None = None) -> Plot:
        """Plot the response of a loop in the complex plane, with its exclusion zone."""
        return self._plot(LoopDiagram.NYQUIST, loop, point)

    def plot_nichols(self, loop: str | None = None, point: str | None = None) -> Plot:
        """Plot gain over phase of a loop, with its exclusion zone."""
        return self._plot(LoopDiagram.NICHOLS, loop, point)

    def plot_sensitivity(self, loop: str | None = None, point: str | None = None) -> Plot:
        """Plot sensitivity and complementary sensitivity of a loop, with their peaks."""
        return self._plot(LoopDiagram.SENSITIVITY, loop, point)

    def plot_poles(self, loop: str | None = None, point: str | None = None) -> Plot:
        """Plot the poles of the closed loop in the z plane."""
        return self._plot(LoopDiagram.POLES, loop, point)

    def plot_step(self, loop: str | None = None, point: str | None = None) -> Plot:
        """Plot the closed loop's response to a step at the cut."""
        return self._plot(LoopDiagram.STEP, loop, point)

    def _plot(self, diagram: LoopDiagram, name: str | None, point: str | None) -> Plot:
        from ..documents.chart.plot import plot_charts  # which imports matplotlib

        loop = decisive_loop(self) if name is None else self.loop(name, point)
        charts = loop_charts(loop, diagram)
        first, *others = (chart.title for chart in charts)
        titles = [f"{loop.name} at {loop.point}; {first}", *others]
        return plot_charts(
            charts, SIZE / len(charts), 1.2 * SIZE if diagram is LoopDiagram.BODE else SIZE, titles=titles
        )


@verb(STABILITY)
def stability(system: FilePath, **options: Unpack[StabilityOptions]) -> StabilityReport:
    """Compute margins, poles and robustness of a system's loops: `perilune stability`; see docs/stability.md.

    ``loops`` are names that the system declares (default: all), or connectors ``component.connector`` to cut at one or
    several times ``at`` (s). With ``at``, declared loops are studied at these times, too, with the settings of their
    points. ``campaign`` disperses the margins over its trials; ``configuration`` selects one of several. ``trial``
    studies the sample of a single trial instead. Other options are as in `simulate`. Raises InputError, and StudyError
    if a simulation of the study fails.
    """
    at, campaign, draws = options["at"], options["campaign"], options["draws"]
    times = (at,) if isinstance(at, int | float) else tuple(at)
    request = read_request(
        os.fspath(system),
        system_options(options),
        loops=options["loops"],
        at=times,
        campaign=None if campaign is None else os.fspath(campaign),
        configuration=options["configuration"],
        trials=options["trials"],
        seed=options["seed"],
        trial=options["trial"],
        draws=None if draws is None else Path(draws),
    )
    done = study(request, study_command, options["workers"])
    texts = {name: value for name, value in {**options, "at": times}.items() if name != "workers"}  # affects no number
    return StabilityReport(**vars(done), command=write_command(STABILITY, {"system": system}, texts))
