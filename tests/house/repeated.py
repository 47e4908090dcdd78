"""Measures of names that occur again: classes, files; and of long functions."""

from __future__ import annotations

import ast
from collections import defaultdict

from .size import Measure
from .sources import PRODUCT, Checkout

LONG = 50  # lines


def classes(checkout: Checkout) -> Measure:
    """Count the names that more than one class of the product has, of all names of its classes."""
    owners = defaultdict(list)
    for source in checkout.below(*PRODUCT):
        for node in source.nodes:
            if isinstance(node, ast.ClassDef):
                owners[node.name].append(f"{source.path}:{node.lineno}")
    entries = [f"{name}: {', '.join(where)}" for name, where in sorted(owners.items()) if len(where) > 1]
    return f"{len(entries)} of {len(owners)}", entries


def files(checkout: Checkout) -> Measure:
    """Count the names that three files of the product or more have, `__init__` apart."""
    owners = defaultdict(list)
    for source in checkout.below(*PRODUCT):
        if source.path.name != "__init__.py":
            owners[source.path.name].append(str(source.path.parent))
    entries = [f"{name}: {', '.join(where)}" for name, where in sorted(owners.items()) if len(where) > 2]
    return str(len(entries)), entries


def long_functions(checkout: Checkout) -> Measure:
    """Count the functions of `analysis` and `common` with more than 50 lines below the docstring."""
    entries = []
    for source in checkout.below(*PRODUCT[:2]):
        for node in source.nodes:
            if isinstance(node, ast.FunctionDef):
                body = [statement for statement in node.body if statement not in source.docstrings]
                if body and (body[-1].end_lineno or 0) - body[0].lineno + 1 > LONG:
                    entries.append(f"{source.path}:{node.lineno} {node.name}")
    return str(len(entries)), entries
