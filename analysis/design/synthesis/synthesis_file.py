"""Reader of the TOML file of a synthesis: a campaign, and the table [network_operator] of the search."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

from ....common.errors import InputError
from ....common.paths import SEARCHES
from ...campaigns.definition.campaign import Campaign
from ...campaigns.definition.campaign_source import read_source_file
from ...campaigns.definition.expressions import Expression
from ...campaigns.definition.file import SYNTHESIS, parse_campaign
from ...campaigns.definition.plan import BatchPlan
from ...campaigns.definition.table import TomlTable, expression, integer, number, text
from ...runtime.system.options import SystemOptions
from ..laws.law import NetworkOperator, find_law, law_parameters, read_law
from .search_settings import SearchSettings
from .variations import OUTPUTS, SIZE, SOURCES, edges_in, edges_out

OWN_KEYS = ("component", "fmu", "law", "step", "stop_time", "objectives")
REFUSED = {  # tables of a campaign that a search does not permit, with the reason
    "compare": "a synthesis evaluates one law at a time",
    "record": "a synthesis stores no simulations",
    "group": "a synthesis evaluates a law on all trials",
    "requirement": "a synthesis judges a law by its objectives",
}
LIMITS: Mapping[str, tuple[float, float]] = {
    "population": (2, 5000),
    "generations": (1, 100_000),
    "crossovers": (1, 100_000),
    "variations": (1, 1000),
    "elites": (0, 5000),
    "mutation": (0.0, 1.0),
    "crossover": (0.0, 1.0),
    "renewal": (1, 100_000),
    "integer_bits": (0, 24),
    "fraction_bits": (0, 24),
}


@dataclass(frozen=True)
class Synthesis:
    """Declaration of a synthesis.

    ``fmu``, if named, replaces the FMU of ``component``; the search begins with the law ``basic``; ``objectives``
    contains expressions over metrics, by name, to be minimised. ``step`` and ``stop_time`` (s) replace the values of
    the system. ``sha256`` is the hash of the file.
    """

    campaign: Campaign
    component: str
    fmu: str | None
    basic: NetworkOperator
    settings: SearchSettings
    objectives: Mapping[str, Expression]
    step: float | None
    stop_time: float | None
    sha256: str

    def plan(self, seed: int | None = None) -> BatchPlan:
        """Return the plan that is simulated for every candidate; ``seed`` replaces the campaign's."""
        campaign = self.campaign if seed is None else replace(self.campaign, seed=seed)
        options = SystemOptions(
            use={} if self.fmu is None else {self.component: self.fmu}, step=self.step, stop_time=self.stop_time
        )
        overlaid = tuple(law_parameters(self.basic, self.component))
        return BatchPlan(campaign.system, campaign, options, self.sha256, overlaid)


def find_search(name: str) -> Path:
    """Return the file of a search: a path, or laws/searches/NAME.toml of this repository for a bare name."""
    own = SEARCHES / f"{name}.toml"
    return own if own.is_file() and Path(name).name == name else Path(name)


def read_synthesis(path: Path) -> Synthesis:
    """Return the synthesis in a TOML file. Raises InputError."""
    whole = read_source_file(path).table()
    if SYNTHESIS not in whole.content:
        raise whole.error(SYNTHESIS, "missing", f"add [{SYNTHESIS}] with component, law and objectives")
    for key, reason in REFUSED.items():
        if key in whole.content:
            raise whole.error(
                key,
                f"not allowed here: {reason}",
                "remove this table; perilune batch can simulate the law that was found",
            )
    remainder = {key: value for key, value in whole.content.items() if key != SYNTHESIS}
    campaign = parse_campaign(TomlTable(remainder, whole.file, origins=whole.origins, attached=whole.attached))
    table = whole.table(SYNTHESIS)
    settings_keys = [field.name for field in fields(SearchSettings)]
    table.only([*OWN_KEYS, *settings_keys])
    settings = _settings(table)
    component = table.get("component", text)
    law_path = find_law(table.get("law", text), path.parent)
    basic = read_law(law_path)
    _check_basic(basic, settings, law_path)
    for name in (*campaign.input_names(), *campaign.settings):
        if name in law_parameters(basic, component):
            raise InputError(
                campaign.file,
                name,
                "a parameter of the law, which the search sets",
                "do not draw or set this parameter",
            )
    return Synthesis(
        campaign=campaign,
        component=component,
        fmu=table.get("fmu", text, None),
        basic=basic,
        settings=settings,
        objectives=_objectives(table.table("objectives"), campaign),
        step=table.get("step", _positive, None),
        stop_time=table.get("stop_time", _positive, None),
        sha256=hashlib.sha256(path.read_bytes()).hexdigest(),
    )


def _settings(table: TomlTable) -> SearchSettings:
    values: dict[str, Any] = {}
    for field in fields(SearchSettings):
        if field.name in table.content:
            kind: Callable[[TomlTable, str, object], float] = {"int": integer, "float": number, "bool": _truth}[
                str(field.type)
            ]
            values[field.name] = table.get(field.name, kind)
    settings = SearchSettings(**values)
    for name, (low, high) in LIMITS.items():
        if not low <= getattr(settings, name) <= high:
            raise table.error(name, f"{values[name]!r} is out of range", f"give {low:g} to {high:g}")
    if settings.elites >= settings.population:
        problem = f"{settings.elites} elites fill the population of {settings.population}"
        raise table.error("elites", problem, "give fewer elites, or a larger population")
    if settings.coding.bits == 0:
        raise table.error(
            "fraction_bits", "integer_bits and fraction_bits are both 0", "give at least one bit to one of them"
        )
    return settings


def _objectives(table: TomlTable, campaign: Campaign) -> dict[str, Expression]:
    metrics = {metric.name for metric in campaign.metrics}
    objectives: dict[str, Expression] = {}
    for name in table.content:
        if not name.isidentifier():
            raise table.error(name, f"{name!r} is not a plain name", "use letters, digits and _")
        objectives[name] = table.get(name, expression)
        for unknown in sorted(objectives[name].names - metrics):
            raise table.error(name, f"{unknown!r} is not a metric", "use names declared under [metric.NAME]")
    if not objectives:
        raise table.error("", "no objective", 'add one or more: name = "expression over metrics"')
    return objectives


def _check_basic(law: NetworkOperator, settings: SearchSettings, path: Path) -> None:
    """Reject a basic solution that the search cannot vary or encode."""
    for node in range(SOURCES, SIZE):
        if not edges_in(law.matrix, node) and (node in OUTPUTS or edges_out(law.matrix, node)):
            problem = f"no edge leads to node {node + 1}"
            raise InputError(path, "matrix", problem, "add an edge to the node, or remove the edges from it")
    coding = settings.coding
    try:
        coding.encode(law.q)
    except ValueError as error:
        place = error.args[0]
        problem = f"{law.q[place]:g} is outside 0 to 2^{coding.integer}"
        raise InputError(
            path, f"q[{place + 1}]", problem, "give more integer_bits, or another basic solution"
        ) from error


def _truth(table: TomlTable, key: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise table.error(key, f"{value!r} is neither true nor false", "write true or false")
    return value


def _positive(table: TomlTable, key: str, value: object) -> float:
    positive = number(table, key, value)
    if positive <= 0.0:
        raise table.error(key, f"{positive:g} s", "give more than 0 s")
    return positive
