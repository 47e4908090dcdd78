"""Parameter bindings read: the values that they apply, and those that a mapping leaves out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from .archive import SystemArchive
from .description import Binding
from .documents import children, read_document
from .parameter_sets import Assignment, apply_mapping, read_parameter_file, read_parameter_set


def read_binding(archive: SystemArchive, file: str, binding: Binding) -> tuple[list[Assignment], Sequence[Assignment]]:
    """The values of a binding of the document ``file``, the prefix put before their names and then mapped.

    With those that its mapping has no entry for, which are not applied (SSP 1.0, ParameterBindings). Raises InputError.
    """
    element = f"ParameterBinding (line {binding.line})"
    if binding.source is not None:
        source = f"{archive.label}!{binding.source}"
        values = read_parameter_file(archive.read(binding.source, element), source)
    else:
        assert binding.inline is not None  # the reader refuses a binding with neither
        values = read_parameter_set(binding.inline, file)
    values = [replace(value, name=binding.prefix + value.name) for value in values]
    entries = binding.mapping_inline
    if binding.mapping_source is not None:
        file = f"{archive.label}!{binding.mapping_source}"
        entries = read_document(archive.read(binding.mapping_source, element), "ssm", file)
    if entries is None:
        return values, ()
    mapped = {entry.get("source") for entry in children(entries, "ssm:MappingEntry")}
    return apply_mapping(values, entries, file), [value for value in values if value.name not in mapped]
