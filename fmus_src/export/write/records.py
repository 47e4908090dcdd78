"""C structs of a kernel's records, and their operations."""

from __future__ import annotations

from collections.abc import Callable

from ..judge.kernel import FLOAT, Kernel, RecordType, VectorType
from ..judge.subset import records_of
from .layout import CodeLines
from .names import c_type, declaration, identifier

# name: arguments, expression of a float, and of a vector of a size
OPERATIONS: dict[str, tuple[str, str, str]] = {
    "add": ("{type} a, {type} b", "a.{0} + b.{0}", "add{1}(a.{0}, b.{0})"),
    "subtract": ("{type} a, {type} b", "a.{0} - b.{0}", "subtract{1}(a.{0}, b.{0})"),
    "negative": ("{type} a", "-a.{0}", "negative{1}(a.{0})"),
    "scale": ("double k, {type} a", "k * a.{0}", "scale{1}(k, a.{0})"),
    "divide": ("{type} a, double k", "a.{0} / k", "divide{1}(a.{0}, k)"),
}


def write_records(kernel: Kernel) -> list[str]:
    """Write the definitions of a kernel's records, each after the records of its fields."""
    return [_definition(kind) for kind in records_of(kernel)]


def _definition(kind: RecordType) -> str:
    lines = CodeLines()
    lines.open(f"typedef struct {c_type(kind)} {{")
    for name, field in kind.record.fields.items():
        unit = f"{field.unit}: " if field.unit and field.unit != "1" else ""
        frame = f" ({field.frame} frame)" if field.frame else ""
        about = f"{unit}{field.description}{frame}" or name
        lines.member(f"{declaration(kind.field(name), identifier(name))};", about)
    lines.close(f"}} {c_type(kind)};")
    lines.text.append("")
    if kind.is_space:
        for name, (arguments, of_float, of_vector) in OPERATIONS.items():
            write = _field_writer(kind, of_float, of_vector)
            _write_operation(lines, kind, f"{name}_{c_type(kind)}({arguments.format(type=c_type(kind))})", write)
        _write_checked_division(lines, kind)
    return "\n".join(lines.text)


def _field_writer(kind: RecordType, of_float: str, of_vector: str) -> Callable[[str], str]:
    """Return a function that writes an operation on a field."""

    def write(name: str) -> str:
        inner = kind.field(name)
        if inner is FLOAT:
            return of_float.format(identifier(name))
        size = inner.size if isinstance(inner, VectorType) else f"_{c_type(inner)}"
        return of_vector.format(identifier(name), size)

    return write


def _write_operation(lines: CodeLines, kind: RecordType, head: str, write: Callable[[str], str]) -> None:
    lines.open(f"static inline {c_type(kind)} {head}\n{{")
    lines.add(f"return ({c_type(kind)}){{{', '.join(map(write, kind.record.fields))}}};")
    lines.close("}")
    lines.text.append("")


def _write_checked_division(lines: CodeLines, kind: RecordType) -> None:
    """Write the division of a record by a number that may be zero."""
    name = c_type(kind)
    lines.open(
        f"static inline {name} py_divide_{name}(Fault *fault, const char *file, int line, {name} a, double k)\n{{"
    )
    lines.open("if (k == 0.0) {")
    lines.add("set_fault(fault, file, line, ZERO_DIVISION);")
    lines.add("return a;")
    lines.close("}")
    lines.add(f"return divide_{name}(a, k);")
    lines.close("}")
    lines.text.append("")
