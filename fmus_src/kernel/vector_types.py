"""Vectors of two, three or four floats. Vectors are immutable values: operators return new ones.

`vector(x, y, z)` creates one. `+`, `-`, and `*` and `/` by a number or another vector operate component by component;
the scalar product is `vectors.dot`. `v[k]`, `v.x`, `v[1:4]` and `x, y, z = v` read components; four components are
named w, x, y, z, as in a quaternion with its scalar first. In C a vector is a struct that is passed and returned by
value, with the same operations in kernel_vectors.h.

The operators are unrolled for each size (`operations.py`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, ClassVar, Self

from .operations import add_method, add_operators, fill


class Vector:
    """Base of vectors of all sizes; as an annotation in a kernel, a vector of any size."""

    __slots__ = ()
    names: ClassVar[str]

    def __init_subclass__(cls) -> None:
        cls.names = "".join(cls.__slots__)
        _write_methods(cls)

    def __len__(self) -> int:
        return len(self.names)

    def __iter__(self) -> Iterator[float]:
        return iter(self.elements())

    def __eq__(self, other: object) -> bool:
        return self.elements() == tuple(other) if isinstance(other, Vector | list | tuple) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.elements())

    def __repr__(self) -> str:
        return f"vector{self.elements()}"

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """Apply a function of numpy to the vector as an array; a number of numpy times a vector remains a vector."""
        result = getattr(ufunc, method)(
            *[list(each) if isinstance(each, Vector) else each for each in inputs], **options
        )
        numbers = [
            each for each in inputs if not isinstance(each, Vector | list | tuple) and not getattr(each, "ndim", 0)
        ]
        return vector(*result.tolist()) if len(inputs) == 2 and len(numbers) == 1 else result

    def __reduce__(self) -> tuple:
        return vector, self.elements()

    if TYPE_CHECKING:  # generated for each size

        def elements(self) -> tuple[float, ...]:
            """Return the components as a tuple."""

        def __getitem__(self, key: Any) -> Any: ...

        def __add__(self, other: Self) -> Self: ...

        def __sub__(self, other: Self) -> Self: ...

        def __neg__(self) -> Self: ...

        def __rmul__(self, factor: float) -> Self: ...

        def __mul__(self, factor: float | Self) -> Self: ...

        def __truediv__(self, divisor: float | Self) -> Self: ...


def _write_methods(kind: type[Vector]) -> None:
    """Add operators and component access to the vector class of one size."""
    names = tuple(kind.names)
    components = ", ".join(f"self.{name}" for name in names)
    known = {"Vector": Vector, "vector": vector}
    add_method(kind, "elements", "self", [f"return {components}"])
    part = [f"part = ({components})[k]", "return vector(*part) if part.__class__ is tuple else part"]
    add_method(kind, "__getitem__", "self, k", part, known)
    add_operators(kind, names, "Own()")
    refusal = [
        "elif isinstance(factor, Vector):",
        f"    raise TypeError(f'a vector of {len(names)} times one of {{len(factor)}}')",
    ]  # the operator of numpy's number would multiply element by element
    for name, sign, refused in (("__mul__", "*", refusal), ("__truediv__", "/", [])):
        by_component = [f"    {line}" for line in fill(names, f"self.{{0}} {sign} factor.{{0}}")]
        by_number = [f"    {line}" for line in fill(names, f"self.{{0}} {sign} factor")]
        cases = ["if factor.__class__ is Own:", *by_component, *refused, "else:", *by_number]
        add_method(kind, name, "self, factor", ["made = Own()", *cases, "return made"], known)


def vector(first: float, second: float, third: float | None = None, fourth: float | None = None) -> Any:
    """Return a vector of two, three or four components."""
    if third is None:
        two = Vector2()
        two.x = first
        two.y = second
        return two
    if fourth is None:
        three = Vector3()
        three.x = first
        three.y = second
        three.z = third
        return three
    four = Vector4()
    four.w = first
    four.x = second
    four.y = third
    four.z = fourth
    return four


class Vector2(Vector):
    """Vector of two floats."""

    __slots__ = ("x", "y")
    x: float
    y: float


class Vector3(Vector):
    """Vector of three floats."""

    __slots__ = ("x", "y", "z")
    x: float
    y: float
    z: float


class Vector4(Vector):
    """Vector of four floats, such as a quaternion with its scalar first."""

    __slots__ = ("w", "x", "y", "z")
    w: float
    x: float
    y: float
    z: float


VECTORS: dict[int, type[Vector]] = {2: Vector2, 3: Vector3, 4: Vector4}  # by size
