"""C definition of one kernel function."""

from __future__ import annotations

import ast

from ..judge.kernel import BoundFunction, Function, MatrixType, RecordType, Several, VectorType, body_of
from ..judge.source import label
from .names import Names, c_type, declaration, identifier
from .statements import StatementWriter


def signature(function: Function, name: str, block_type: str) -> str:
    """Return a signature such as ``static double terminal_cubic_time(Fault *fault, const double *dr, double g)``."""
    arguments = []
    if function.takes_block:
        arguments.append(f"{'' if function.changes_block else 'const '}{block_type} *self")
    if function.can_fault:
        arguments.append("Fault *fault")
    for parameter, kind in function.parameters.items():
        if isinstance(kind, BoundFunction):
            continue
        arguments.append(declaration(kind, identifier(parameter), parameter not in function.changed_lists))
    returned = c_type(function.returns) if function.returns else "void"
    passed = [*function.parameters.values(), function.returns]
    # vectors that are not inlined go through memory
    hint = "inline " if any(isinstance(kind, VectorType | MatrixType | RecordType | Several) for kind in passed) else ""
    return f"static {hint}{returned} {name}({', '.join(arguments) or 'void'})"


def write_function(function: Function, names: Names, block_type: str) -> list[str]:
    """Write the C definition of a function, with its docstring and the Python line of each statement."""
    node = function.source.node
    docstring = ast.get_docstring(node) or ""
    writer = StatementWriter(function, names)
    writer.lines.comment(f"{function.name} ({label(function.source.path)}:{node.lineno})", docstring)
    writer.lines.add(signature(function, names.functions[function], block_type))
    writer.lines.open("{")
    if docstring:
        writer.last_line = node.body[0].end_lineno or node.lineno
    for name in _find_unused(function):
        writer.lines.add(f"(void){name};")
    writer.block(body_of(node))
    writer.lines.close("}")
    return writer.lines.text


def _find_unused(function: Function) -> list[str]:
    """Return the C names of the arguments that the function does not use."""
    read = {part.id for part in ast.walk(function.source.node) if isinstance(part, ast.Name)}
    valued = [name for name, kind in function.parameters.items() if not isinstance(kind, BoundFunction)]
    unused = [identifier(name) for name in valued if name not in read]
    calls_methods = any(callee.takes_block for callee in function.callees())
    if function.takes_block and "self" not in read and not calls_methods:
        unused.append("self")
    return unused
