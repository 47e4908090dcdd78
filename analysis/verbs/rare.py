"""`perilune.rare`: the probability of a rare failure."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack

from matplotlib.figure import Figure as Plot

from ..campaigns.spec.expressions import Expression
from ..reports.common.notebook import Grid, notebook_view
from ..reports.studies.plots import rare_plot
from ..reports.studies.rare_page import design_table, level_table, write_rare_page
from ..studies.rare import outcome
from ..studies.rare.study import rare_failure
from .common.plans import commands_of, read_campaign
from .common.requirements import read_requirements, requirement_problems
from .common.studies import condition_lines, conditions, extend_result, results_folder, write_results
from .options.option import FilePath
from .options.studies import RARE, RareOptions
from .options.verb import verb

NUMBERS = ("probability", "interval[1]", "interval[2]", "flights")  # on which requirements are


@dataclass(frozen=True, eq=False, repr=False)
class RareResult(outcome.RareResult):
    """A rare failure: ``probability``, ``interval``, ``flights``, ``failures``, and the conditions of all of them.

    ``simulation`` has the levels, ``flown`` every simulation; ``folder`` is where it is stored, if it is.
    """

    folder: Path | None = None
    requirements: Sequence[Expression] = ()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.facts['system']}, {self.headline()})"

    def to_json(self) -> dict[str, Any]:
        """The result for other programs."""
        return self.document(self.folder)

    def lines(self) -> list[str]:
        """What `perilune rare` prints."""
        return [self.text(self.folder)]

    def problems(self) -> list[str]:
        """Requirements that are not met."""
        return requirement_problems(self.requirements, self.values())

    def write(self, folder: FilePath) -> None:
        """Write rare.json, flights.parquet and, where there are failures, failures.parquet."""
        super().write(Path(folder))

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune rare --report`: one HTML file."""
        write_rare_page(self, Path(path), self.folder)

    def plot(self) -> Plot:
        """Limit state over simulations, exceedance probability, failures over the two most influential parameters."""
        return rare_plot(self)

    def _repr_html_(self) -> str:
        grids = [Grid(table.heads, table.rows) for table in (level_table(self), design_table(self))]
        text = [self.headline(), f"{self.flights} simulations", *condition_lines(self)]
        return notebook_view(f"{self.facts['system']}: rare failure", text, grids, self.plot())


@verb(RARE)
def rare(system: FilePath, campaign: FilePath, **options: Unpack[RareOptions]) -> RareResult:
    """The probability of a rare failure over a campaign's dispersions and noise, by subset simulation: `perilune rare`.

    ``failure`` is an expression over metrics and draws, by default that a trial is no success; ``samples`` are the
    simulations of a level, and a failure less probable than ``least`` is given up. ``hold`` fixes dispersed inputs.
    The noise of components is random, unless ``noise_trial`` is the trial of the campaign whose noise all simulations
    have: then the probability is conditional on that realisation. ``compare`` chooses the FMU of a slot that the
    campaign compares; ``output`` is a folder for rare.json, flights.parquet and failures.parquet; ``require`` are
    expressions over probability, interval[1], interval[2] and flights. The rest is as in `batch`. Raises InputError.
    """
    folder = results_folder(options)
    requirements = read_requirements(options["require"], NUMBERS)
    plan = read_campaign(system, campaign, options)
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = rare_failure(
            plan, options["failure"], samples=options["samples"], least=options["least"], **conditions(options)
        )
    result = replace(result, commands=commands_of(plan))
    complete = extend_result(RareResult, result, folder=folder, requirements=requirements)
    write_results(complete, folder)
    return complete
