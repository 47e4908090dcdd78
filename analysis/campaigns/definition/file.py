"""Reader of a campaign's TOML file; unknown entries are rejected by name."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from ....common.errors import InputError, suggestion
from ..draws.interfaces import Draw
from ..draws.lookup import Lookup
from ..draws.supplied import stream_component
from .campaign import SCHEMES, TRACES, Campaign, Metric, Scatter, Setting, TrialRecord, Variant
from .campaign_source import read_source_file
from .distributions import read_draw
from .expressions import RESERVED, Expression, is_name
from .faults import CampaignFault, read_fault
from .reductions import REDUCTIONS
from .requirements import read_requirements
from .table import REQUIRED, TomlTable, bound, choice_of, expression, integer, names, number, sequence, text

SYNTHESIS = "network_operator"  # table read by analysis.synthesis.synthesis_file
# Names of columns in records, tables of results and files of draws
COLUMNS = frozenset({"time", "trial", "variant", "status", "success"})
REDUCTION_OF = {"band": "last_outside", "condition": "first", "delay": "first"}  # keys that only one reduction uses
TABLE = (
    "system", "description", "trials", "seed", "parameters", "draw_scheme", "set", "compare", "configuration", "draw",
    "derive", "fault", "group", "lookup", "metric", "record", "success", "requirement", "scatter",
)  # fmt: skip
SCATTER = ("x", "y", "circle", "title")


def _check_name(table: TomlTable, name: str, taken: Iterable[str]) -> None:
    """Reject the name of a drawn value, derived value or metric that is malformed, reserved or already ``taken``."""
    if not is_name(name):
        remedy = 'use letters, digits and _; for a parameter "component.variable" or "component.variable[1]"'
        raise table.error(name, f"{name!r} is not a name that expressions can use", remedy)
    if name in RESERVED or name in COLUMNS or stream_component(name) is not None:
        raise table.error(name, f"{name!r} is a reserved name", "choose another name")
    if name in taken:
        raise table.error(name, f"{name!r} is declared twice", "give each value one declaration and one name")


def _draws(table: TomlTable) -> tuple[Draw, ...]:
    draws: list[Draw] = []
    selected: list[str] = []
    for name, content in table.flat(of_tables=True):
        if not isinstance(content, dict):
            raise table.error(name, "not a table", f'write [draw."{name}"] with distribution = ... below it')
        draw = read_draw(name, TomlTable(content, table.file, table.place(name), table.origins))
        for filled in draw.names:
            _check_name(table, filled, selected)
            selected.append(filled)
        draws.append(draw)
    return tuple(draws)


def _read_derived(table: TomlTable, draws: tuple[Draw, ...]) -> dict[str, Expression]:
    known = [name for draw in draws for name in draw.names]
    derived: dict[str, Expression] = {}
    for name, value in table.flat():
        _check_name(table, name, known)
        derived[name] = expression(table, name, value)
        _check_names_in(derived[name], known, "a draw or an earlier derived value")
        known.append(name)
    return derived


def _lookup(name: str, table: TomlTable, others: Iterable[str]) -> Lookup:
    _check_name(table, name, others)
    table.only(("file", "column", "inputs"))
    file = table.get("file", text)
    origin = table.where("file")[0]
    label, content = table.attached.get((origin, file), (file, None))
    inputs = table.table("inputs")
    formulas = {key: sequence(_formula)(inputs, key, _as_list(entry)) for key, entry in inputs.content.items()}
    if not formulas:
        raise table.error(
            "inputs", "no input", "name the quantities that its values depend on: name = expression, or a list"
        )
    return Lookup(name, table.get("column", text), formulas, origin, file, label, content)


def _as_list(entry: object) -> list[object]:
    return entry if isinstance(entry, list) else [entry]


def _formula(table: TomlTable, key: str, entry: object) -> Expression:
    return expression(table, key, entry if isinstance(entry, str) else repr(number(table, key, entry)))


def _check_names_in(formula: Expression, known: Iterable[str], kind: str) -> None:
    for unknown in sorted(formula.names - set(known)):
        raise InputError(*formula.where, f"{unknown!r} is not {kind}", suggestion(unknown, known))


def _pair(table: TomlTable, key: str, value: object) -> tuple[float, float]:
    ends = sequence(bound)(table, key, value)
    if len(ends) != 2 or not ends[0] < ends[1]:
        raise table.error(key, f"{value!r} is not an interval", "write [low, high] with low < high")
    return ends[0], ends[1]


def _metric(name: str, table: TomlTable) -> Metric:
    table.only(["expression", "reduction", *REDUCTION_OF, "window", "unit", "description"])
    reduction = table.get("reduction", choice_of(*REDUCTIONS))
    for key, owner in REDUCTION_OF.items():
        if reduction != owner and key in table.content:
            raise table.error(key, f"not used by the reduction {reduction!r}", f"remove {key}, or use {owner}")
    return Metric(
        name=name,
        expression=table.get("expression", expression),
        reduction=reduction,
        band=table.get("band", _pair, REQUIRED if reduction == "last_outside" else None),
        window=table.get("window", _pair, None),
        unit=table.get("unit", text, "1"),
        description=table.get("description", text, ""),
        condition=table.get("condition", expression, REQUIRED if reduction == "first" else None),
        delay=table.get("delay", _seconds_later, 0.0),
    )


def _seconds_later(table: TomlTable, key: str, value: object) -> float:
    seconds = number(table, key, value)
    if seconds < 0.0:
        raise table.error(key, f"{value!r} is negative", "give a delay in seconds, 0 or more")
    return seconds


def _metrics(table: TomlTable, drawn: list[str]) -> tuple[Metric, ...]:
    for name in table.content:
        _check_name(table, name, drawn)
        if not name.isidentifier():
            raise table.error(name, f"{name!r} is not a plain name", "use letters, digits and _")
    return tuple(_metric(name, table.table(name)) for name in table.content)


def _record(table: TomlTable) -> TrialRecord:
    table.only(["final", "every", "signals", "trials", "traces"])
    every = table.get("every", integer, None)
    if every is not None and every < 1:
        raise table.error("every", f"{every} row(s)", "give n >= 1 to record every n-th row")
    nothing: tuple[str, ...] = ()
    signals = table.get("signals", names, nothing)
    if (every is None) != (not signals):
        missing = "signals" if every is not None else "every"
        raise table.error(missing, "missing", "give every = n together with signals = [...], or neither")
    trials = table.get("trials", integer, None)
    if trials is not None and trials < 1:
        raise table.error("trials", f"{trials} trial(s)", "give n >= 1 to record the first n trials")
    if trials is not None and every is None:
        raise table.error(
            "trials", "no signal is recorded over time", "give every = n and signals = [...] as well, or remove trials"
        )
    traces = table.get("traces", choice_of(*TRACES), "none")
    return TrialRecord(table.get("final", names, nothing), every, signals, traces, trials)


def _faults(table: TomlTable, drawn: list[str]) -> tuple[CampaignFault, ...]:
    faults = tuple(read_fault(name, each) for name, each in table.subtables())
    for fault in faults:
        for formula in fault.formulas:
            _check_names_in(formula, drawn, "a draw or a derived value")
    return faults


def _group(table: TomlTable, drawn: list[str]) -> str:
    table.only(["by"])
    name = table.get("by", text)
    if name not in drawn:
        raise table.error("by", f"{name!r} is not a draw or a derived value", suggestion(name, drawn))
    return name


def _success(table: TomlTable, metrics: tuple[Metric, ...]) -> Expression:
    table.only(["expression"])
    success = table.get("expression", expression)
    _check_names_in(success, [metric.name for metric in metrics], "a metric")
    return success


def _scatter(name: str, table: TomlTable, metrics: tuple[Metric, ...]) -> Scatter:
    table.only(SCATTER)
    units = {metric.name: metric.unit for metric in metrics}
    x, y = table.get("x", text), table.get("y", text)
    for key, metric in (("x", x), ("y", y)):
        if metric not in units:
            raise table.error(key, f"{metric!r} is not a metric", suggestion(metric, units))
    circle = table.get("circle", number, None)
    if circle is not None and circle <= 0.0:
        raise table.error("circle", f"{circle:g} is not a radius", "give a positive number")
    if circle is not None and units[x] != units[y]:
        raise table.error(
            "circle", f"{x} is in {units[x]}, but {y} is in {units[y]}", "remove circle, or choose metrics in one unit"
        )
    return Scatter(name, x, y, circle, table.get("title", text, ""))


def parse_campaign(table: TomlTable) -> Campaign:
    """Return the campaign declared in a table, which was read from a file or created in memory. Raises InputError."""
    if SYNTHESIS in table.content:
        remedy = "search with perilune design search, then simulate the law in a campaign without this table"
        raise table.error(SYNTHESIS, "declares a search, which perilune batch cannot run", remedy)
    table.only(TABLE)
    draws = _draws(table.table("draw"))
    derived = _read_derived(table.table("derive"), draws)
    sampled = [name for draw in draws for name in draw.names] + list(derived)
    lookups = tuple(_lookup(name, each, sampled) for name, each in table.table("lookup").subtables())
    metrics = _metrics(table.table("metric"), [*sampled, *(lookup.name for lookup in lookups)])
    return Campaign(
        file=table.file,
        system=table.get("system", text),
        trials=table.get("trials", integer),
        seed=table.get("seed", integer),
        draw_scheme=table.get("draw_scheme", choice_of(*SCHEMES), SCHEMES[0]),
        success=_success(table.table("success"), metrics),
        metrics=metrics,
        draws=draws,
        derived=derived,
        settings=read_settings(table.table("set"), sampled),
        compare={slot: names(each, slot, fmus) for each in [table.table("compare")] for slot, fmus in each.flat()},
        configurations=read_configurations(table, sampled),
        parameters=table.get("parameters", names, ()),
        record=_record(table.table("record")),
        description=" ".join(table.get("description", text, "").split()),
        group=_group(table.table("group"), sampled) if "group" in table.content else None,
        faults=_faults(table.table("fault"), sampled),
        scatters=tuple(_scatter(name, each, metrics) for name, each in table.table("scatter").subtables()),
        lookups=lookups,
        requirements=read_requirements(table.table("requirement"), [metric.name for metric in metrics], draws),
    )


def read_campaign(path: Path) -> Campaign:
    """Return the campaign in a TOML file. Raises InputError."""
    return parse_campaign(read_source_file(path).table())


KEYS = ("use", "parameters", "set")


def read_settings(table: TomlTable, dispersed: Sequence[str]) -> dict[str, Setting]:
    """Return the values of [set]. Raises InputError."""
    settings: dict[str, Setting] = {}
    for name, value in table.flat():
        match value:
            case bool() | float() | int() | str():
                settings[name] = value
            case list() if value and all(isinstance(item, float | int) for item in value):
                settings[name] = value
            case _:
                remedy = "give a number, true, false or a text; for a vector a list of numbers"
                raise table.error(name, f"{value!r} is not a valid value", remedy)
        if "." not in name:
            raise table.error(name, "names no component", "write component.variable = value")
        if name in dispersed:
            raise table.error(name, "is also drawn or derived", "keep one of the two")
    return settings


def read_configurations(campaign: TomlTable, dispersed: Sequence[str]) -> tuple[Variant, ...]:
    """Return the configurations of a campaign, in the order of its file. Raises InputError."""
    declared = campaign.table("configuration")
    if declared.content and campaign.table("compare").content:
        remedy = "write the compared FMUs as configurations, or remove the configurations"
        raise declared.error("", "cannot be combined with [compare]", remedy)
    for name in declared.content:
        if not name.replace("-", "_").isidentifier():
            raise declared.error(name, f"{name!r} is not a plain name", "use letters, digits, - and _")
    return tuple(_configuration(name, declared.table(name), dispersed) for name in declared.content)


def _configuration(name: str, table: TomlTable, dispersed: Sequence[str]) -> Variant:
    table.only(KEYS)
    use = table.table("use")
    return Variant(
        name,
        use={slot: text(use, slot, fmu) for slot, fmu in use.flat()},
        parameters=table.get("parameters", names, ()),
        settings=read_settings(table.table("set"), dispersed),
    )
