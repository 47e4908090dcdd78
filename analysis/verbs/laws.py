"""Laws of network operators: `perilune.law`, a law with formula, parameter set and graph; `perilune.synthesize`."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from ...common.atomic import write_atomically
from ...common.errors import InputError
from ...common.targets import check_folder
from ..design.laws import law as laws
from ..design.laws.law import find_law, parameter_set
from ..design.synthesis import synthesis_outcome
from ..design.synthesis.synthesis import run_synthesis
from ..design.synthesis.synthesis_file import find_search, read_synthesis
from ..documents.model import Document
from ..documents.of.design.law import law_document
from ..documents.of.design.law_figures import INCH, law_chart, law_diagram
from ..documents.of.design.synthesis import synthesis_document
from ..options.option import FilePath
from ..options.verb import verb
from .common.documented import Documented
from .options.design import LAW, SEARCH, LawOptions, SearchOptions

if TYPE_CHECKING:  # imported where needed: matplotlib is slow to import
    from matplotlib.figure import Figure as Plot


@dataclass(frozen=True)
class Law(Documented, laws.NetworkOperator):
    """A law of a network operator: its matrix and parameters, shown as formula and graph, written as parameter set.

    ``component`` is the component to which the parameter set applies.
    """

    component: str = "guidance"

    def document(self) -> Document:
        """Return a document with formula, parameters and graph."""
        return law_document(self)

    def write(self, path: FilePath) -> None:
        """Write the law's file (.json)."""
        super().write(Path(path))

    def write_parameters(self, path: FilePath, component: str | None = None) -> None:
        """Write the parameter set (.ssv) of the law for ``component``, by default the component of the law."""
        write_atomically(Path(path), parameter_set(self, component or self.component))

    def write_graph(self, path: FilePath) -> None:
        """Write the law's graph as a drawing (.svg)."""
        _write_graph(self, Path(path))

    def plot(self) -> Plot:
        """Plot the graph of the law."""
        from ..documents.chart.plot import plot_charts  # which imports matplotlib

        chart, width, height = law_chart(self)
        return plot_charts([chart], height / INCH, width / INCH)


@dataclass
class SynthesisResult(Documented, synthesis_outcome.SynthesisOutcome):
    """Result of a search for a law; ``ended`` is the reason for its end: success, generations or evaluations."""

    def document(self) -> Document:
        """Return a document with the end of the search, the chosen law and the Pareto set."""
        return synthesis_document(self)

    def problems(self) -> list[str]:
        """Return a line with a remedy if no law succeeded in all trials."""
        if self.succeeded:
            return []
        evaluation = self.search.choose().evaluation
        return [
            f"{self.synthesis.campaign.file}: no law found: the chosen one succeeds in {evaluation.successes} of "
            f"{self.search.evaluator.trials} trials; give more generations, another `seed` or another basic solution"
        ]

    def write(self, folder: FilePath) -> None:
        """Write pareto.json, law.json, law.ssv, log.csv and law.svg."""
        super().write(folder)
        _write_graph(self.law, Path(folder) / "law.svg")


def _write_graph(law: laws.NetworkOperator, path: Path) -> None:
    from ..documents.render.diagram import diagram_svg

    write_atomically(path, f"{diagram_svg(law_diagram(law))}\n".encode())


@verb(LAW)
def law(name: FilePath, **options: Unpack[LawOptions]) -> Law:
    """Read a law by name, from laws/, or from its .json file: `perilune design law`. Raises InputError."""
    component = options["component"]
    if not component.isprintable() or "" in component.split("."):
        raise InputError(
            "`component`", repr(component), "not a valid component name", "give the name that the system uses"
        )
    return Law(**vars(laws.read_law(find_law(os.fspath(name)))), component=component)


@verb(SEARCH)
def synthesize(search: FilePath, **options: Unpack[SearchOptions]) -> SynthesisResult:
    """Search for a law of a network operator by simulating every candidate: `perilune design search`.

    ``search`` is a name in laws/searches/ or the path of a campaign with a table [network_operator]. ``output`` is a
    folder for checkpoints, Pareto set and law, from which ``resume`` continues. The search ends with the generation in
    which ``evaluations`` laws have been evaluated. The result's ``succeeded`` is True if the chosen law succeeds in
    every trial. Raises InputError.
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
    if folder is not None:
        _write_graph(result.law, folder / "law.svg")
    return SynthesisResult(**vars(result) | {"folder": folder})
