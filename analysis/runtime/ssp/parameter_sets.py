"""Parameter sets (.ssv) and mappings (.ssm): values by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from lxml import etree

from ....common.errors import InputError
from .archive import SystemArchive
from .conversions import Transformation, Unit, check_type, read_transformation, units_of_document
from .dimensions import Shape, element_name, indices
from .documents import check_schema, child, children, read_document, signatures, tag
from .parameter_values import ParameterValue, read_values
from .system_description import Binding
from .types import RUNTIME_TYPES, runtime_type


@dataclass(frozen=True)
class Assignment:
    """Value for a parameter, with its origin.

    ``type_name`` is Real, Integer, Boolean, Enumeration or String; a value from the command line has the type ``Text``
    and takes the type of its target. An element of an array has its ``index`` in the array and the array's ``shape``.
    """

    name: str
    value: ParameterValue
    type_name: str
    unit: Unit | None
    file: str
    line: int
    transformation: Transformation | None = None
    suppress_unit_conversion: bool = False
    index: Shape = ()
    shape: Shape = ()

    @property
    def array(self) -> str:
        """Name of the array that contains the element, or the name of the assignment itself."""
        return self.name.removesuffix(element_name("", self.index)) if self.index else self.name

    @property
    def where(self) -> str:
        return f"{self.name} (line {self.line})" if self.line else self.name

    @property
    def origin(self) -> str:
        """File name and line of the value, or the option that sets it."""
        name = self.file.rpartition("!")[2].rpartition("/")[2]
        return f"{name} line {self.line}" if self.line else name


Notes = list[str] | None  # collects flaws that are tolerated in files of other tools; None if flaws are rejected


def _flaw(notes: Notes, file: str, where: str, problem: str, effect: str, remedy: str) -> None:
    """Note a flaw and its effect on the value, or raise InputError."""
    if notes is None:
        raise InputError(file, where, problem, f"{remedy}, or allow it with `allow_unmatched`")
    notes.append(f"{file}: {where}: {problem}: {effect}")


def read_parameter_set(
    root: etree._Element, file: str, notes: Notes = None, units: Mapping[str, Unit] | None = None
) -> list[Assignment]:
    """Return the values in a ParameterSet element; ``units`` are the units defined by a surrounding document.

    Raises InputError.
    """
    check_schema(root, "ssv", file)
    units = {**(units or {}), **units_of_document(root, "ssv", file)}
    assignments: dict[str, list[Assignment]] = {}
    for parameter in children(child(root, "ssv:Parameters"), "ssv:Parameter"):
        name, line = parameter.get("name", ""), parameter.sourceline
        where = f"{name} (line {line})"
        if name in assignments:
            _flaw(notes, file, where, "given twice in one parameter set", "this value is used", "remove one")
        for item in parameter:
            if tag(item) == "Binary":
                raise InputError(file, where, "Binary values are not supported", "remove the Binary value")
            if tag(item) in RUNTIME_TYPES:
                unit_name = item.get("unit") or None
                if unit_name is not None and unit_name not in units:
                    problem, effect = f"unit {unit_name} is not defined here", "the value is used without conversion"
                    _flaw(notes, file, where, problem, effect, "add it under Units")
                shape, values = read_values(parameter, item, file)
                kind, unit = runtime_type(tag(item)), units.get(unit_name or "")
                assignments[name] = [
                    Assignment(element_name(name, index), value, kind, unit, file, line, index=index, shape=shape)
                    for index, value in zip(indices(shape), values, strict=True)
                ]
    return [assignment for elements in assignments.values() for assignment in elements]


def apply_mapping(
    assignments: list[Assignment], root: etree._Element, file: str, notes: Notes = None
) -> list[Assignment]:
    """Return the assignments selected by a ParameterMapping, under their target names. Raises InputError."""
    check_schema(root, "ssm", file)
    by_name: dict[str, list[Assignment]] = {}
    for assignment in assignments:
        by_name.setdefault(assignment.array, []).append(assignment)
    mapped: list[Assignment] = []
    for entry in children(root, "ssm:MappingEntry"):
        source, line = entry.get("source", ""), entry.sourceline
        if source not in by_name:
            problem = "the parameter set has no such parameter"
            _flaw(notes, file, f"{source} (line {line})", problem, "not applied", "correct or remove the entry")
            continue
        transformation = read_transformation(entry)
        check_type(transformation, by_name[source][0].type_name, file, f"{source} (line {line})")
        suppress = entry.get("suppressUnitConversion") in ("true", "1")
        mapped += [
            replace(
                origin,
                name=element_name(entry.get("target", ""), origin.index),
                file=file,
                line=line,
                transformation=transformation,
                suppress_unit_conversion=suppress,
            )
            for origin in by_name[source]
        ]
    return mapped


def read_parameter_file(
    data: bytes, file: str, notes: Notes = None, remarks: list[str] | None = None
) -> list[Assignment]:
    """Return the values in an .ssv document; add a line to ``remarks`` for each signature. Raises InputError."""
    root = read_document(data, "ssv", file)
    _remark(remarks, root, file)
    return read_parameter_set(root, file, notes)


def _remark(remarks: list[str] | None, root: etree._Element, file: str) -> None:
    if remarks is not None:
        remarks += [f"{file}: {note}" for note in signatures(root)]


def read_binding(
    archive: SystemArchive,
    file: str,
    binding: Binding,
    units: Mapping[str, Unit],
    notes: Notes = None,
    remarks: list[str] | None = None,
) -> tuple[list[Assignment], Sequence[Assignment]]:
    """Return the mapped and prefixed values of a binding in the document ``file``, and the unmapped values.

    Values without an entry in the mapping are not applied (SSP 1.0, ParameterBindings). ``units`` are the units defined
    by the document; ``remarks`` receives a line for each signature in the binding's files. Raises InputError.
    """
    element = f"ParameterBinding (line {binding.line})"
    if binding.source is not None:
        source = f"{archive.label}!{binding.source}"
        values = read_parameter_file(archive.read(binding.source, element), source, notes, remarks)
    else:
        assert binding.inline is not None  # the reader rejects a binding with neither
        values = read_parameter_set(binding.inline, file, notes, units)
    values = [replace(value, name=binding.prefix + value.name) for value in values]
    entries = binding.mapping_inline
    if binding.mapping_source is not None:
        file = f"{archive.label}!{binding.mapping_source}"
        entries = read_document(archive.read(binding.mapping_source, element), "ssm", file)
        _remark(remarks, entries, file)
    if entries is None:
        return values, ()
    mapped = {entry.get("source") for entry in children(entries, "ssm:MappingEntry")}
    return apply_mapping(values, entries, file, notes), [value for value in values if value.array not in mapped]
