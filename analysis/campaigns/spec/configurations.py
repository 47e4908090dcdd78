"""How a campaign builds its system: values of [set], FMUs of [compare], [configuration.NAME] with all of them."""

from __future__ import annotations

from collections.abc import Sequence

from .campaign import Setting, Variant
from .toml.table import Table, names, text

KEYS = ("use", "parameters", "set")


def read_settings(table: Table, dispersed: Sequence[str]) -> dict[str, Setting]:
    """The values of [set]. Raises InputError."""
    settings: dict[str, Setting] = {}
    for name, value in table.flat():
        numbers = isinstance(value, list) and value and all(isinstance(item, float | int) for item in value)
        if not numbers and not isinstance(value, float | int | bool | str):
            remedy = "give a number, true, false or a text; of a vector a list of numbers"
            raise table.error(name, f"{value!r} is no value", remedy)
        if "." not in name:
            raise table.error(name, "names no component", "write component.variable = value")
        if name in dispersed:
            raise table.error(name, "also dispersed or derived", "keep one of the two")
        settings[name] = value
    return settings


def read_compare(table: Table) -> dict[str, tuple[str, ...]]:
    """The FMUs of [compare], by slot. Raises InputError."""
    return {slot: names(table, slot, value) for slot, value in table.flat()}


def read_configurations(campaign: Table, dispersed: Sequence[str]) -> tuple[Variant, ...]:
    """The configurations of a campaign, in the order of its file. Raises InputError."""
    declared = campaign.table("configuration")
    if declared.content and campaign.table("compare").content:
        remedy = "write the compared FMUs as configurations, or leave the configurations out"
        raise declared.error("", "given together with [compare]", remedy)
    for name in declared.content:
        if not name.replace("-", "_").isidentifier():
            raise declared.error(name, f"{name!r} is not a plain name", "use letters, digits, - and _")
    return tuple(_configuration(name, declared.table(name), dispersed) for name in declared.content)


def _configuration(name: str, table: Table, dispersed: Sequence[str]) -> Variant:
    table.only(KEYS)
    use = table.table("use")
    return Variant(
        name,
        use={slot: text(use, slot, fmu) for slot, fmu in use.flat()},
        parameters=table.get("parameters", names, ()),
        settings=read_settings(table.table("set"), dispersed),
    )
