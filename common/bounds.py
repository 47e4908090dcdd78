"""Bounds on the size of files and simulations, checked before memory is allocated.

The environment variable named PERILUNE_ and the bound's name in capitals changes a bound.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

from .errors import InputError

PREFIX = "PERILUNE_"


class ExcessError(InputError):
    """Input that exceeds a bound and is not processed."""


@dataclass(frozen=True)
class Bound:
    """Upper bound, ``default`` unless the environment sets another value; ``subject`` names the counted quantity."""

    name: str
    default: float
    unit: str
    subject: str

    @property
    def variable(self) -> str:
        """Name of the environment variable."""
        return f"{PREFIX}{self.name.upper()}"

    @property
    def limit(self) -> float:
        """Bound in effect. Raises InputError if the environment variable is not a positive number."""
        text = os.environ.get(self.variable)
        if text is None:
            return self.default
        try:
            number = float(text)
        except ValueError:
            number = -1.0
        if not number > 0.0:
            raise InputError(self.variable, text, "not a positive number", "correct or unset this variable")
        return number

    def check(self, number: float, file: str | os.PathLike[str], element: str) -> None:
        """Raise ExcessError if a number exceeds the bound."""
        if number > self.limit:
            problem = f"{self.subject}: {number:.6g} {self.unit}, at most {self.limit:.6g} are accepted"
            raise ExcessError(file, element, problem, f"if you trust this input, set {self.variable}")


ARCHIVE_BYTES = Bound("archive_bytes", 2e9, "bytes", "content of an archive (.ssp, .fmu), unpacked")
ARCHIVE_ENTRIES = Bound("archive_entries", 10_000, "files", "files of an archive")
XML_BYTES = Bound("xml_bytes", 256e6, "bytes", "an XML document")
XML_TAGS = Bound("xml_tags", 1.5e6, "tags", "elements of an XML document, opened and closed")
ARRAY_ELEMENTS = Bound("array_elements", 1e6, "elements", "arrays of a description")
CAMPAIGN_BYTES = Bound("campaign_bytes", 256e3, "bytes", "the file of a campaign or of a law")
CAMPAIGN_FILES = Bound("campaign_files", 100, "files", "files that a campaign extends")
EXPRESSION_CHARACTERS = Bound("expression_characters", 10_000, "characters", "an expression")
GRID_POINTS = Bound("grid_points", 10_000, "points", "values of a grid or of a sweep")
INPUT_BYTES = Bound("input_bytes", 2e9, "bytes", "a file of inputs, draws or parameters, a manifest or its contents")
MEMORY_FRACTION = Bound("memory_fraction", 0.25, "of the free memory", "samples of a simulation, inputs over time")
TRIALS = Bound("trials", 1e9, "trials", "trials of a campaign")
TABLE_TRIALS = Bound("table_trials", 1e6, "trials", "trials drawn as one table, rows of a file of draws")
SHARDS = Bound("shards", 1e6, "shards", "shards of a campaign")
BOUNDS = (
    ARCHIVE_BYTES,
    ARCHIVE_ENTRIES,
    XML_BYTES,
    XML_TAGS,
    ARRAY_ELEMENTS,
    CAMPAIGN_BYTES,
    CAMPAIGN_FILES,
    EXPRESSION_CHARACTERS,
    GRID_POINTS,
    INPUT_BYTES,
    MEMORY_FRACTION,
    TRIALS,
    TABLE_TRIALS,
    SHARDS,
)

DOCUMENTS = (".ssd", ".ssv", ".ssm", ".ssb", ".xml")


def bound_of(name: str) -> Bound:
    """Return the bound for a file according to the suffix of its name."""
    if name.endswith(DOCUMENTS):
        return XML_BYTES
    return CAMPAIGN_BYTES if name.endswith(".toml") else ARCHIVE_BYTES
