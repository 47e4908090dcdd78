"""Files of control laws: the matrix and parameters of a network operator as JSON, and as a parameter set."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from ....common.atomic import write_atomically
from ....common.bounds import CAMPAIGN_BYTES
from ....common.errors import InputError, suggestion
from ....common.paths import LAWS
from ....common.regular import read_input
from ....fmus_src.evidence.parameter_set import write_parameter_set
from ....fmus_src.mathlib.network_operator import BINARY_OPERATIONS, SIZE, UNARY_OPERATIONS

FORMAT, VERSION = "perilune-network-operator", 1
KEYS = ("format", "version", "name", "description", "matrix", "q", "exp_saturation")
EXP_SATURATIONS = ("true", "legacy")  # indexed by the blocks' parameter exp_saturation
PARAMETERS = 3

Matrix = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class NetworkOperator:
    """Control law as a network operator.

    ``matrix`` has SIZE rows, with operations as in `fmus_src.mathlib.network_operator`; ``q`` are the law's parameters;
    ``exp_saturation`` selects the value of exp where it would exceed 1e8: 1e8 for ``true``, ln 1e8 for ``legacy``.
    """

    name: str
    matrix: Matrix
    q: tuple[float, ...]
    exp_saturation: str
    description: str = ""

    def content(self) -> dict[str, object]:
        """Return the content of the law's file."""
        return {
            "format": FORMAT,
            "version": VERSION,
            "name": self.name,
            "description": self.description,
            "matrix": [list(row) for row in self.matrix],
            "q": list(self.q),
            "exp_saturation": self.exp_saturation,
        }

    def write(self, path: Path) -> None:
        """Write the law's file, with a line for each row of the matrix."""
        rows = ",\n".join(f"  [{', '.join(f'{entry:2d}' for entry in row)}]" for row in self.matrix)
        lines = {key: json.dumps(value, ensure_ascii=False) for key, value in self.content().items()}
        lines["matrix"] = f"[\n{rows}\n ]"
        text = ",\n".join(f' "{key}": {value}' for key, value in lines.items())
        write_atomically(path, f"{{\n{text}\n}}\n".encode())


def find_law(name: str, folder: Path | None = None) -> Path:
    """Return the file of a law: laws/NAME.json of this repository for a bare name, otherwise a path from ``folder``."""
    if (LAWS / f"{name}.json").is_file() and Path(name).name == name:
        return LAWS / f"{name}.json"
    path = (folder or Path()) / name
    if not path.is_file():
        known = [entry.stem for entry in LAWS.glob("*.json")]
        raise InputError(str(path), "law", "no such law or file", f"{suggestion(name, known)}, or give a path")
    return path


def read_law(path: Path) -> NetworkOperator:
    """Return the law in a file. Raises InputError, which names a wrong cell as matrix[row,column], counted from 1."""
    try:
        text = read_input(path, "give a law's file", CAMPAIGN_BYTES).decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError(path, f"byte {error.start}", "not UTF-8", "save the file as UTF-8") from error
    try:
        document = json.loads(text, object_pairs_hook=_pairs, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise InputError(path, "", f"not JSON: {error}", "correct the file at that place") from error
    return law_of(document, str(path))


def law_of(document: object, file: str) -> NetworkOperator:
    """Return the law in the content of a JSON file, which errors refer to as ``file``. Raises InputError."""

    def refuse(element: str, problem: str, remedy: str) -> NoReturn:
        raise InputError(file, element, problem, remedy)

    if not isinstance(document, dict):
        refuse("", "not a law", f"write an object with the keys {', '.join(KEYS)}")
    for key in document:
        if key not in KEYS:
            refuse(key, "unknown key", f"allowed here: {', '.join(KEYS)}")
    for key in KEYS:
        if key not in document:
            refuse(key, "missing", "add it")
    if document["format"] != FORMAT:
        refuse("format", f"{document['format']!r} is not a law", f'give "{FORMAT}"')
    if document["version"] is True or document["version"] != VERSION:
        refuse("version", f"{document['version']!r} is unknown", f"this Perilune reads version {VERSION}")
    for key in ("name", "description"):
        if not isinstance(document[key], str) or not document[key].isprintable():
            refuse(
                key, f"{document[key]!r} is not a single line of text", "write it in quotes, without control characters"
            )
    if not document["name"].strip():
        refuse("name", "empty", "give the law a name")
    if document["exp_saturation"] not in EXP_SATURATIONS:
        refuse("exp_saturation", f"{document['exp_saturation']!r} is unknown", 'write "true" or "legacy"')
    return NetworkOperator(
        name=document["name"],
        matrix=_matrix(document["matrix"], file),
        q=_parameters(document["q"], file),
        exp_saturation=document["exp_saturation"],
        description=document["description"],
    )


def _matrix(rows: object, file: str) -> Matrix:
    if not isinstance(rows, list) or len(rows) != SIZE:
        actual = f"{len(rows)} row(s)" if isinstance(rows, list) else f"{rows!r}"
        raise InputError(
            file, "matrix", f"{actual}, but {SIZE} rows are needed", f"give {SIZE} rows of {SIZE} integers"
        )
    for row, entries in enumerate(rows, 1):
        if not isinstance(entries, list) or len(entries) != SIZE:
            actual = f"{len(entries)} entries" if isinstance(entries, list) else f"{entries!r}"
            problem = f"row {row} has {actual}, but {SIZE} are needed"
            raise InputError(file, "matrix", problem, f"give {SIZE} rows of {SIZE} integers")
        for column, entry in enumerate(entries, 1):
            wrong = _find_problem(row, column, entry)
            if wrong is not None:
                raise InputError(file, f"matrix[{row},{column}]", *wrong)
    return tuple(tuple(entries) for entries in rows)


def _find_problem(row: int, column: int, entry: object) -> tuple[str, str] | None:
    """Return the problem of a wrong cell and its remedy; rows and columns count from 1."""
    if isinstance(entry, bool) or not isinstance(entry, int):
        return f"{entry!r} is not a whole number", "write an integer"
    if row > column:
        return (f"{entry} is below the diagonal", "write 0: the matrix is upper triangular") if entry else None
    if row == column:
        known = ", ".join(map(str, BINARY_OPERATIONS))
        return None if entry in BINARY_OPERATIONS else (f"{entry} is not a binary operation", f"use one of {known}")
    if entry == 0 or entry in UNARY_OPERATIONS:
        return None
    known = ", ".join(map(str, UNARY_OPERATIONS))
    return f"{entry} is not a unary operation", f"use 0 for no edge, or one of {known}"


def _parameters(values: object, file: str) -> tuple[float, ...]:
    if not isinstance(values, list) or len(values) != PARAMETERS:
        raise InputError(file, "q", f"{values!r} is not a list of {PARAMETERS} numbers", f"give {PARAMETERS} numbers")
    for index, value in enumerate(values, 1):
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not abs(value) <= 1e308 or not math.isfinite(value):
            raise InputError(file, f"q[{index}]", f"{value!r} is not a finite number", "give a finite number")
    return tuple(float(value) for value in values)


def _pairs(pairs: Sequence[tuple[str, object]]) -> dict[str, object]:
    content: dict[str, object] = {}
    for key, value in pairs:
        if key in content:
            raise ValueError(f"{key} occurs twice")
        content[key] = value
    return content


def _refuse_constant(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a number")


def law_parameters(law: NetworkOperator, component: str) -> dict[str, int | float]:
    """Return the values of the parameters matrix, q and exp_saturation of ``component``, by name."""
    values: dict[str, int | float] = {}
    for row, entries in enumerate(law.matrix, 1):
        for column, entry in enumerate(entries, 1):
            values[f"{component}.matrix[{row},{column}]"] = entry
    for index, value in enumerate(law.q, 1):
        values[f"{component}.q[{index}]"] = value
    values[f"{component}.exp_saturation"] = EXP_SATURATIONS.index(law.exp_saturation)
    return values


def parameter_set(law: NetworkOperator, component: str) -> bytes:
    """Return the content of an .ssv file with the whole law, including zeros of the matrix."""
    return write_parameter_set(law.name, law_parameters(law, component), law.description)
