"""Records: named values of a fixed layout, immutable, with the operations of a vector space.

    class Motion(Record):
        position = Field(Vector3, unit="m", description="position of the centre of mass")
        speed = Field(unit="m/s", description="speed relative to the ground")

    s = Motion(position=vector(0.0, 0.0, 0.0), speed=3.0)
    t = replace(s, speed=s.speed + 1.0)

`+`, `-`, and `*` and `/` by a number operate field by field, in the order of declaration, if all fields are floats,
vectors or records of these; a record with an int or a bool has no operators. In C a record is a struct that is passed
and returned by value.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from .operations import add_method, add_operators
from .vector_types import VECTORS, Vector, vector

SCALARS = (float, int, bool)


@dataclass(frozen=True)
class Field:
    """Field of a record: type, unit, frame and description.

    ``kind`` is float, int, bool, Vector2, Vector3, Vector4 or a record; ``frame`` is the frame of a vector's
    components; ``frozen`` has the same meaning as for a block's `State`.
    """

    kind: Any = float
    unit: str | None = None
    frame: str | None = None
    description: str = ""
    frozen: bool = False

    if TYPE_CHECKING:  # records hold plain values under the same name

        def __get__(self, instance: object, owner: type | None = None) -> Any: ...


class _RecordType(type):
    """Metaclass that replaces the declared fields of a record class by slots of its instances."""

    def __new__(cls, name: str, bases: tuple[type, ...], namespace: dict[str, Any]) -> _RecordType:
        fields = {key: value for key, value in namespace.items() if isinstance(value, Field)}
        for base in bases:
            if getattr(base, "fields", None):
                raise TypeError(f"{name}: a record cannot inherit from another; make {base.__name__} one of its fields")
        for key, field in fields.items():
            if not (field.kind in SCALARS or field.kind in VECTORS.values() or isinstance(field.kind, _RecordType)):
                raise TypeError(f"{name}.{key}: a field is a float, int, bool, vector or record, not {field.kind!r}")
        plain = {key: value for key, value in namespace.items() if key not in fields}
        created: Any = super().__new__(cls, name, bases, {**plain, "__slots__": tuple(fields), "fields": fields})
        if fields:
            _write_methods(created)
        return created


class Record(metaclass=_RecordType):
    """Base of record classes."""

    fields: ClassVar[dict[str, Field]]

    def elements(self) -> tuple[Any, ...]:
        """Return the numbers of all fields in order of declaration."""
        return tuple(_flatten(getattr(self, name) for name in self.fields))

    @classmethod
    def of_elements(cls, elements: Sequence[Any]) -> Any:
        """Return the record whose fields contain these numbers, in order of declaration."""
        return _take(cls, iter(elements))

    def __eq__(self, other: object) -> bool:
        return self.elements() == other.elements() if type(other) is type(self) else NotImplemented  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash(self.elements())

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)!r}' for name in self.fields)})"

    def __reduce__(self) -> tuple:
        return type(self).of_elements, (self.elements(),)

    if TYPE_CHECKING:  # generated for each class

        def __init__(self, **values: Any) -> None: ...

        def __add__(self, other: Any) -> Any: ...

        def __sub__(self, other: Any) -> Any: ...

        def __neg__(self) -> Any: ...

        def __mul__(self, factor: float) -> Any: ...

        def __rmul__(self, factor: float) -> Any: ...

        def __truediv__(self, divisor: float) -> Any: ...


R = TypeVar("R", bound=Record)


def replace(record: R, **changes: Any) -> R:
    """Return a copy of the record with new values for some fields."""
    copy = object.__new__(type(record))
    for name in record.fields:
        setattr(copy, name, changes.pop(name) if name in changes else getattr(record, name))
    if changes:
        raise TypeError(f"{type(record).__name__} has no field {next(iter(changes))!r}")
    return copy


def is_space(kind: Any) -> bool:
    """Return True if values of a field type can be added and scaled."""
    if isinstance(kind, _RecordType):
        return all(is_space(field.kind) for field in kind.fields.values())  # type: ignore[attr-defined]
    return kind is float or kind in VECTORS.values()


def count_numbers(kind: Any) -> int:
    """Return the number of scalars in a value of a field type."""
    if isinstance(kind, _RecordType):
        return sum(count_numbers(field.kind) for field in kind.fields.values())  # type: ignore[attr-defined, misc]
    return 1 if kind in SCALARS else len(kind.names)


def flat_fields(record: type[Record], prefix: str = "") -> list[tuple[str, Field]]:
    """Return the name and field of each number, with names such as ``attitude[1]`` and ``motion.speed``."""
    numbers: list[tuple[str, Field]] = []
    for name, field in record.fields.items():
        if isinstance(field.kind, _RecordType):
            numbers += flat_fields(field.kind, f"{prefix}{name}.")  # type: ignore[arg-type]
        elif field.kind in SCALARS:
            numbers.append((f"{prefix}{name}", field))
        else:
            numbers += [(f"{prefix}{name}[{k + 1}]", field) for k in range(len(field.kind.names))]
    return numbers


def _write_methods(record: Any) -> None:
    """Add a constructor to a record class and, if its fields form a vector space, the operators."""
    assigned = [f"self.{name} = {name}" for name in record.fields]
    add_method(record, "__init__", f"self, *, {', '.join(record.fields)}", assigned)
    if is_space(record):
        add_operators(record, tuple(record.fields), "new(Own)")


def _flatten(values: Any) -> Iterator[Any]:
    for value in values:
        if isinstance(value, Vector | Record):
            yield from value.elements()
        else:
            yield value


def _take(kind: Any, elements: Iterator[Any]) -> Any:
    """Return a value of a field type built from the next elements."""
    if isinstance(kind, _RecordType):
        record: Any = object.__new__(kind)  # type: ignore[arg-type]
        for name, field in kind.fields.items():  # type: ignore[attr-defined]
            setattr(record, name, _take(field.kind, elements))
        return record
    if kind in SCALARS:
        return next(elements)
    return vector(*[next(elements) for _ in kind.names])
