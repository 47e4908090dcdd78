"""Attribute relativeQuantity of variables, which FMPy misses because it reads it from the wrong element."""

from __future__ import annotations

from fmpy.model_description import ModelDescription
from lxml import etree

STATED = ("ModelVariables/ScalarVariable/Real[@relativeQuantity]", "ModelVariables/*[@relativeQuantity]")


def complete_quantities(description: ModelDescription, root: etree._Element) -> None:
    """Set relativeQuantity on the variables in FMPy's description that declare it, and on their aliases."""
    stated: dict[str | None, bool] = {}
    for path in STATED:
        for element in root.iterfind(path):
            owner = element if element.tag != "Real" else element.getparent()
            assert owner is not None  # a path found it
            stated[owner.get("name")] = element.get("relativeQuantity", "").strip() in ("true", "1")
    for variable in description.modelVariables if stated else ():
        name = variable.name if variable.alias is None else variable.alias.name
        if name in stated:
            variable.relativeQuantity = stated[name]
