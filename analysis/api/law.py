"""Laws of network operators from Python."""

from __future__ import annotations

import os
from pathlib import Path

from matplotlib.figure import Figure as Plot

from ..atomic import write_atomically
from ..laws import law as laws
from ..laws.formula import formula_text
from ..laws.graph import law_figure
from ..laws.law import named_law
from ..laws.parameter_set import parameter_set
from ..reports.kit.style import house_style
from .notebook import Grid, notebook_view
from .options import FilePath


class Law(laws.Law):
    """A network operator's law: its matrix and parameters, as formula, drawing and parameter set."""

    def text(self) -> str:
        """The law as a formula, for a terminal."""
        return formula_text(self)

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
