"""perilune law: a network operator as formula, parameter set and drawing."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..atomic import write_atomically
from ..errors import InputError
from ..laws.formula import formula, formula_text
from ..laws.graph import law_svg
from ..laws.law import named_law, read_law
from ..laws.parameter_set import parameter_set
from .common.options import add_json, write_json


def add(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("law", metavar="LAW", help="a law of laws/ by name, or the path of its .json file")
    parser.add_argument("--output", type=Path, metavar="F.ssv", help="write the parameter set that flies it")
    parser.add_argument("--component", metavar="NAME", help="the component it is for; default: guidance")
    parser.add_argument("--graph", type=Path, metavar="F.svg", help="draw its graph")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    for option, path, suffix in (("--output", options.output, ".ssv"), ("--graph", options.graph, ".svg")):
        if path is not None and path.suffix != suffix:
            raise InputError(option, str(path), f"not {suffix}", f"end the name with {suffix}")
    if options.component is not None and options.output is None:
        raise InputError("--component", options.component, "names nothing without --output", "give both or neither")
    component = options.component if options.component is not None else "guidance"
    if not component.isprintable() or "" in component.split("."):
        raise InputError("--component", repr(component), "not a component's name", "name it as the system does")
    law = read_law(named_law(options.law))
    if options.output is not None:
        write_atomically(options.output, parameter_set(law, component))
    if options.graph is not None:
        write_atomically(options.graph, law_svg(law))
    if not write_json(law.document() | {"formula": formula(law)}, options.json):
        print(formula_text(law))
    return 0
