"""Structures of `c/run.h` as ctypes, filled from named arrays and numbers.

Only the header declares their members. A member is filled from the attribute of the same name: a pointer with the
address of an array, whose dtype is checked; ``NAME_rows`` and ``NAME_columns`` with the dimensions of the array NAME; a
nested structure member by member.
"""

from __future__ import annotations

import ctypes
import re
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np

SCALARS: dict[str, tuple[Any, type[np.generic]]] = {
    "bool": (ctypes.c_bool, np.uint8),
    "double": (ctypes.c_double, np.float64),
    "int32_t": (ctypes.c_int32, np.int32),
    "int64_t": (ctypes.c_int64, np.int64),
    "uint8_t": (ctypes.c_uint8, np.uint8),
    "uint32_t": (ctypes.c_uint32, np.uint32),
    "uint64_t": (ctypes.c_uint64, np.uint64),
}
STRUCTURE = re.compile(r"^typedef struct \{\n(.*?)^\} (\w+);", re.DOTALL | re.MULTILINE)
MEMBER = re.compile(r"^    (?:const )?(\w+) (\*?)(\w+);", re.MULTILINE)
ENUMERATOR = re.compile(r"\b([A-Z]\w*) = (\d+)\b")
SIZES = {"_rows": 0, "_columns": 1}  # suffix of a member: axis of the array


class Member(NamedTuple):
    """Member of a structure.

    ``dtype`` is the dtype of the array to which the member points, and ``axis`` the axis whose length it contains; both
    may be None.
    """

    name: str
    source: str  # attribute from which the member is filled
    dtype: Any
    axis: int | None
    is_structure: bool


class FilledStructure:
    """Structure of run.h, with references to its arrays, so that they are not freed."""

    def __init__(self, name: str) -> None:
        self.memory = structures()[name]()
        self._sources: dict[str, Any] = {}  # by the path of the member

    def fill(self, source: Any) -> None:
        """Fill all members from the attributes of ``source``, except attributes that are the same objects as before.

        Raises TypeError for an array that has a wrong dtype or is not contiguous.
        """
        self._fill(self.memory, source, "")

    def _fill(self, memory: Any, source: Any, path: str) -> None:
        for member in memory.members:
            attribute = getattr(source, member.source)
            if member.axis is not None:
                setattr(memory, member.name, attribute.shape[member.axis])
            elif member.dtype is None and not member.is_structure:
                setattr(memory, member.name, attribute)
            elif attribute is not None and attribute is not self._sources.get(
                path_of_member := f"{path}.{member.name}"
            ):
                if member.is_structure:
                    self._fill(getattr(memory, member.name), attribute, path_of_member)
                else:
                    setattr(memory, member.name, _address(attribute, member.dtype, path_of_member))
                self._sources[path_of_member] = attribute


def _address(array: np.ndarray, dtype: Any, path: str) -> int:
    if array.dtype != dtype or not array.flags.c_contiguous:
        raise TypeError(f"{path}: an array of {array.dtype}, {array.strides}, where the loop reads {dtype.__name__}")
    return array.ctypes.data


@cache
def structures() -> dict[str, Any]:
    """Return a ctypes.Structure for each structure of the header; its ``members`` describe its members in order."""
    known: dict[str, Any] = {}
    for body, name in STRUCTURE.findall(read_header("run.h")):
        rows = list(_members(body, known))
        fields = [(member.name, kind) for member, kind in rows]
        members = [member for member, _ in rows]
        known[name] = type(name, (ctypes.Structure,), {"_fields_": fields, "members": members})
    return known


def _members(body: str, known: dict[str, Any]) -> Iterator[tuple[Member, Any]]:
    """Yield the members of a structure, with their ctypes."""
    arrays: set[str] = set()
    for kind, pointer, name in MEMBER.findall(body):
        if pointer:
            arrays.add(name)
            yield Member(name, name, SCALARS[kind][1], None, False), ctypes.c_void_p
        elif kind in known:
            yield Member(name, name, None, None, True), known[kind]
        else:
            array, _, suffix = name.rpartition("_")
            axis = SIZES[f"_{suffix}"] if array in arrays and f"_{suffix}" in SIZES else None
            yield Member(name, name if axis is None else array, None, axis, False), SCALARS[kind][0]


def enumerators(header: str) -> dict[str, int]:
    """Return the constants of a header's enumerations by name."""
    return {name: int(number) for name, number in ENUMERATOR.findall(read_header(header))}


def read_header(name: str) -> str:
    """Return the text of a header."""
    return files(__package__).joinpath("c", name).read_text(encoding="utf-8")
