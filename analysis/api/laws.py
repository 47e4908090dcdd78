"""Laws of network operators from Python: read, and searched for."""

from __future__ import annotations

import os
from pathlib import Path

from matplotlib.figure import Figure as Plot

from ..common.atomic import write_atomically
from ..design.laws import law as laws
from ..design.laws.formula import formula_text
from ..design.laws.graph import law_figure
from ..design.laws.law import named_law
from ..design.laws.parameter_set import parameter_set
from ..design.synthesis.outcome import SynthesisResult
from ..design.synthesis.synthesis import run_synthesis
from ..design.synthesis.synthesis_file import named_search, read_synthesis
from ..reports.common.notebook import Grid, notebook_view
from ..reports.common.style import house_style
from .options import FilePath


class Law(laws.Law):
    """A network operator's law: its matrix and parameters, as formula, drawing and parameter set."""

    def text(self) -> str:
        """The law as a formula, for a terminal."""
        return formula_text(self)

    def write(self, path: FilePath) -> None:
        """Write the law's file (.json)."""
        super().write(Path(path))

    def write_parameters(self, path: FilePath, component: str = "guidance") -> None:
        """Write the parameter set (.ssv) that makes a component fly it."""
        write_atomically(Path(path), parameter_set(self, component))

    def plot(self) -> Plot:
        """The law's graph."""
        with house_style():
            return law_figure(self)

    def _repr_html_(self) -> str:
        lines = [(line,) for line in self.text().splitlines() if line.strip()]
        return notebook_view(self.name, [self.description], [Grid(("formula",), lines)], self.plot())


def law(name: FilePath) -> Law:
    """A law of laws/ by name, or from its .json file: `perilune law`. Raises InputError."""
    return Law(**vars(laws.read_law(named_law(os.fspath(name)))))


def synthesize(
    search: FilePath,
    *,
    seed: int | None = None,
    workers: int | None = None,
    output: FilePath | None = None,
    resume: bool = False,
    evaluations: int | None = None,
) -> SynthesisResult:
    """Search for a law of a network operator, every candidate flown: `perilune synthesize network-operator`.

    ``search`` is a name of laws/searches/ or the path of a campaign with what to search for; ``output`` a folder for
    checkpoints, Pareto set and law, from which ``resume`` goes on; the search ends with the generation in which
    ``evaluations`` laws have flown. Whether a law was found is the result's ``succeeded``. Raises InputError.
    """
    return run_synthesis(
        read_synthesis(named_search(os.fspath(search))),
        seed=seed,
        workers=workers,
        output=None if output is None else Path(output),
        resume=resume,
        evaluations=evaluations,
    )
