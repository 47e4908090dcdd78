"""perilune law: a network operator as formula, parameter set and drawing."""

from __future__ import annotations

import argparse

from ..common.atomic import write_atomically
from ..common.errors import InputError
from ..common.targets import Results, check_file
from ..design.laws.formula import formula, formula_text
from ..design.laws.graph import law_svg
from ..design.laws.law import named_law, read_law
from ..design.laws.parameter_set import parameter_set
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_file("--output", options.output, (".ssv",))
    check_file("--graph", options.graph, (".svg",))
    check_json(options)
    if options.component is not None and options.output is None:
        raise InputError("--component", options.component, "names nothing without --output", "give both or neither")
    component = options.component if options.component is not None else "guidance"
    if not component.isprintable() or "" in component.split("."):
        raise InputError("--component", repr(component), "not a component's name", "name it as the system does")
    law = read_law(named_law(options.law))
    files = Results()
    files.write(options.output, lambda path: write_atomically(path, parameter_set(law, component)))
    files.write(options.graph, lambda path: write_atomically(path, law_svg(law)))
    document = law.document() | {"formula": formula(law)}
    return tell(document, options, lambda: print(formula_text(law)), files)
