"""Document of a network operator's law: formula, parameters and graph."""

from __future__ import annotations

from collections.abc import Sequence

from ....design.laws.expression_tree import OUTPUT_NUMBERS
from ....design.laws.formula import formula
from ....design.laws.law import NetworkOperator
from ...cell import Code
from ...model import Document, Node, Section, Table, Text
from .law_figures import law_diagram

OUTPUTS = {f"z{number}": f"u{index} = " for index, number in enumerate(OUTPUT_NUMBERS, 1)}


def law_document(law: NetworkOperator) -> Document:
    """Return the document of a law."""
    summary = [Text(law.description.rstrip("."))] if law.description else []
    sections = [Section("", formula_nodes(law)), Section("Graph", [law_diagram(law)])]
    return Document(law.name, summary, sections, law.content() | {"formula": formula(law)})


def formula_nodes(law: NetworkOperator) -> Sequence[Node]:
    """Return the parameters and the formula, a row for each output and for each node that is used more than once."""
    rows = [[Code(f"{OUTPUTS.get(name, '')}{name} = {right}")] for name, right in formula(law).items()]
    numbers = ", ".join(f"q{index} = {number:.10g}" for index, number in enumerate(law.q, 1))
    return [Table(["formula"], rows, listed=len(rows)), Text([Code(numbers), f"; exp saturates {law.exp_saturation}"])]
