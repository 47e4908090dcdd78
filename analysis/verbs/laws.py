"""Network operators: `perilune.law`, formula, parameter set and drawing; `perilune.synthesize`, a search for one."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from ...common.atomic import write_atomically
from ...common.errors import InputError
from ...common.targets import check_folder
from ..design.laws import law as laws
from ..design.laws.formula import formula, formula_text
from ..design.laws.graph import INCH, law_chart, law_svg
from ..design.laws.law import find_law, parameter_set
from ..design.synthesis.outcome import SynthesisResult
from ..design.synthesis.synthesis import run_synthesis
from ..design.synthesis.synthesis_file import find_search, read_synthesis
from ..options.option import FilePath
from ..options.verb import verb
from ..reports.common.notebook import Grid, notebook_view
from .options.design import LAW, SEARCH, LawOptions, SearchOptions
from .result import NoProblems

if TYPE_CHECKING:  # plots are imported where they are made: matplotlib takes as long as all the rest
    from matplotlib.figure import Figure as Plot


@dataclass(frozen=True)
class Law(NoProblems, laws.Law):
    """A network operator's law: its matrix and parameters, as formula, drawing and parameter set.

    ``component`` is what the parameter set is for.
    """

    component: str = "guidance"

    def lines(self) -> list[str]:
        """The law as a formula, for a terminal."""
        return formula_text(self).splitlines()

    def to_json(self) -> dict[str, object]:
        """The content of the law's file, and the formula."""
        return self.document() | {"formula": formula(self)}

    def write(self, path: FilePath) -> None:
        """Write the law's file (.json)."""
        super().write(Path(path))

    def write_parameters(self, path: FilePath, component: str | None = None) -> None:
        """Write the parameter set (.ssv) of the law, for its ``component`` unless another is given."""
        write_atomically(Path(path), parameter_set(self, component or self.component))

    def write_graph(self, path: FilePath) -> None:
        """Draw the law's graph (.svg)."""
        write_atomically(Path(path), law_svg(self))

    def plot(self) -> Plot:
        """The law's graph."""
        from ..reports.chart.plot import plot_charts

        chart, width, height = law_chart(self)
        return plot_charts([chart], height / INCH, width / INCH)

    def _repr_html_(self) -> str:
        lines = [(line,) for line in self.lines() if line.strip()]
        return notebook_view(self.name, [self.description], [Grid(("formula",), lines)], self.plot())


@verb(LAW)
def law(name: FilePath, **options: Unpack[LawOptions]) -> Law:
    """Read a law of laws/ by name, or from its .json file: `perilune design law`.

    ``component`` is the one that `Law.write_parameters` writes for. Raises InputError.
    """
    component = options["component"]
    if not component.isprintable() or "" in component.split("."):
        raise InputError("`component`", repr(component), "not a component's name", "name it as the system does")
    return Law(**vars(laws.read_law(find_law(os.fspath(name)))), component=component)


@verb(SEARCH)
def synthesize(search: FilePath, **options: Unpack[SearchOptions]) -> SynthesisResult:
    """Search for a law of a network operator, every candidate simulated: `perilune design search`.

    ``search`` is a name of laws/searches/ or the path of a campaign that says what to search for; ``output`` a folder
    for checkpoints, Pareto set and law, from which ``resume`` continues; the search ends with the generation in which
    ``evaluations`` laws have been evaluated. The result's ``succeeded`` says whether the chosen law has every trial a
    success. Raises InputError.
    """
    folder = None if options["output"] is None else Path(options["output"])
    check_folder("`output`", folder, overwrite=options["resume"], otherwise="`resume` to continue")
    result = run_synthesis(
        read_synthesis(find_search(os.fspath(search))),
        seed=options["seed"],
        workers=options["workers"],
        output=folder,
        resume=options["resume"],
        evaluations=options["evaluations"],
    )
    result.folder = folder
    return result
