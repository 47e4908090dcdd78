"""The distributions that a campaign's file can name, and the draw of a table [draw.NAME]."""

from __future__ import annotations

from ...draws.declared import Draw
from ..toml.table import Table, choice_of, names
from .discrete import Choice, Grid
from .intervals import LatinHypercube, Sobol, Uniform
from .normals import CorrelatedNormal, Normal

KINDS = (Uniform, Normal, CorrelatedNormal, Choice, Grid, LatinHypercube, Sobol)
DISTRIBUTIONS = {kind.keyword: kind for kind in KINDS}


def read_draw(name: str, table: Table) -> Draw:
    """The draw declared in the table [draw.NAME]. Raises InputError."""
    kind = DISTRIBUTIONS[table.get("distribution", choice_of(*DISTRIBUTIONS))]
    distribution = kind.read(table)
    return Draw(name, table.get("names", names) if kind is CorrelatedNormal else (name,), distribution)
