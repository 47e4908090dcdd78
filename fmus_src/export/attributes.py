"""Check for undeclared attributes of a block, before any simulation."""

from __future__ import annotations

import ast
import difflib
import inspect
import textwrap
from types import FunctionType

from ..block import Block


class UndeclaredError(ValueError):
    """Error of a block that uses an undeclared attribute; the message names file, line, attribute and remedy."""


def check_attributes(block_class: type[Block]) -> None:
    """Reject methods that use self.NAME where NAME is neither a variable nor an attribute of the class.

    The value of an undeclared attribute would be lost at a reset, in a saved state and between the trials of a batch.
    The translator makes the same check for kernels; this check is for Python-only blocks and for uses without
    translation. Raises `UndeclaredError`.
    """
    for owner in block_class.__mro__:
        if owner in (Block, object):
            continue
        for method in vars(owner).values():
            if isinstance(method, FunctionType):
                _check_method(block_class, method)


def _check_method(block_class: type[Block], method: FunctionType) -> None:
    try:
        lines, first = inspect.getsourcelines(method)
    except OSError:  # no source, as for a generated block
        return
    tree = ast.parse(textwrap.dedent("".join(lines)))
    me = next(iter(inspect.signature(method).parameters), "")
    for node in ast.walk(tree):
        if not isinstance(node, ast.Attribute):
            continue
        where = f"{method.__code__.co_filename}:{first + node.lineno - 1}"
        if isinstance(node.value, ast.Attribute) and _is_of(me, node.value):
            bundle = block_class.bundles.get(node.value.attr)
            if bundle is not None and node.attr not in bundle.names:
                members = ", ".join(bundle.names)
                raise UndeclaredError(f"{where}: self.{node.value.attr} has no {node.attr}; it has {members}")
        if not _is_of(me, node) or node.attr in block_class.variables or hasattr(block_class, node.attr):
            continue
        near = difflib.get_close_matches(node.attr, block_class.variables, n=3)
        remedy = f"did you mean {' or '.join(near)}? Else declare" if near else "declare"
        external = ", or ExternalState(...) for an object of a library," if block_class.python_only else ","
        raise UndeclaredError(
            f"{where}: self.{node.attr} is not declared in {block_class.__name__}; "
            f"{remedy} it in the class, {node.attr} = State(...){external} or keep it in a local variable"
        )


def _is_of(me: str, node: ast.Attribute) -> bool:
    """Return True if a node is ``me.NAME``."""
    return isinstance(node.value, ast.Name) and node.value.id == me
