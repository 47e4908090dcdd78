"""Vectors of two, three or four floats, as values: what `a + b` or `h * v` makes is new, and none ever changes.

`vector(x, y, z)` makes one. `+`, `-`, and `*` and `/` by a number or by another vector, component by
component; the scalar product is `vectors.dot`. `v[k]`, `v.x` (w, x, y, z of four, as of a quaternion, scalar
first), `v[1:4]` and `x, y, z = v` read components; to change one, make a new vector. In C a vector is a struct
that is passed and returned by value, with the same operations in kernel_vectors.h.

Every operator is written out for each size, and what it makes is filled slot by slot: in the Python FMUs that
takes 1.5 times as long as loops over lists, a subclass of tuple 2.2 times, a class of any size 2.6 times.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, ClassVar


class Vector:
    """What vectors of all sizes have in common; in a kernel's declaration, a vector of any size."""

    __slots__ = ()
    names: ClassVar[str]

    def __init_subclass__(cls) -> None:
        cls.names = "".join(cls.__slots__)

    def elements(self) -> tuple[float, ...]:
        """The components as a tuple."""
        raise NotImplementedError

    def __len__(self) -> int:
        return len(self.names)

    def __iter__(self) -> Iterator[float]:
        return iter(self.elements())

    def __getitem__(self, key: Any) -> Any:
        part = self.elements()[key]
        return vector(*part) if isinstance(part, tuple) else part

    def __eq__(self, other: object) -> bool:
        return self.elements() == tuple(other) if isinstance(other, Vector | list | tuple) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.elements())

    def __repr__(self) -> str:
        return f"vector{self.elements()}"

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        """numpy's functions give arrays, but a number of numpy's times a vector is a vector."""
        result = getattr(ufunc, method)(
            *[list(each) if isinstance(each, Vector) else each for each in inputs], **options
        )
        numbers = [
            each for each in inputs if not isinstance(each, Vector | list | tuple) and not getattr(each, "ndim", 0)
        ]
        return vector(*result.tolist()) if len(inputs) == 2 and len(numbers) == 1 else result

    def __reduce__(self) -> tuple:
        return vector, self.elements()


class Vector2(Vector):
    """Two floats."""

    __slots__ = ("x", "y")
    x: float
    y: float

    def elements(self) -> tuple[float, float]:
        return self.x, self.y

    def __getitem__(self, k: Any) -> Any:
        part = (self.x, self.y)[k]
        return vector(*part) if part.__class__ is tuple else part  # type: ignore[misc]

    def __add__(self, other: Vector2) -> Vector2:
        if other.__class__ is not Vector2:
            return NotImplemented
        made = Vector2()
        made.x = self.x + other.x
        made.y = self.y + other.y
        return made

    def __sub__(self, other: Vector2) -> Vector2:
        if other.__class__ is not Vector2:
            return NotImplemented
        made = Vector2()
        made.x = self.x - other.x
        made.y = self.y - other.y
        return made

    def __neg__(self) -> Vector2:
        made = Vector2()
        made.x = -self.x
        made.y = -self.y
        return made

    def __rmul__(self, factor: float) -> Vector2:
        made = Vector2()
        made.x = factor * self.x
        made.y = factor * self.y
        return made

    def __mul__(self, factor: float | Vector2) -> Vector2:
        made = Vector2()
        if factor.__class__ is Vector2:
            made.x = self.x * factor.x  # type: ignore[union-attr]
            made.y = self.y * factor.y  # type: ignore[union-attr]
        elif isinstance(factor, Vector):
            raise TypeError(f"a vector of 2 times one of {len(factor)}")
        else:
            made.x = self.x * factor  # type: ignore[assignment, operator]
            made.y = self.y * factor  # type: ignore[assignment, operator]
        return made

    def __truediv__(self, divisor: float | Vector2) -> Vector2:
        made = Vector2()
        if divisor.__class__ is Vector2:
            made.x = self.x / divisor.x  # type: ignore[union-attr]
            made.y = self.y / divisor.y  # type: ignore[union-attr]
        else:
            made.x = self.x / divisor  # type: ignore[assignment, operator]
            made.y = self.y / divisor  # type: ignore[assignment, operator]
        return made


class Vector3(Vector):
    """Three floats."""

    __slots__ = ("x", "y", "z")
    x: float
    y: float
    z: float

    def elements(self) -> tuple[float, float, float]:
        return self.x, self.y, self.z

    def __getitem__(self, k: Any) -> Any:
        part = (self.x, self.y, self.z)[k]
        return vector(*part) if part.__class__ is tuple else part  # type: ignore[misc]

    def __add__(self, other: Vector3) -> Vector3:
        if other.__class__ is not Vector3:
            return NotImplemented
        made = Vector3()
        made.x = self.x + other.x
        made.y = self.y + other.y
        made.z = self.z + other.z
        return made

    def __sub__(self, other: Vector3) -> Vector3:
        if other.__class__ is not Vector3:
            return NotImplemented
        made = Vector3()
        made.x = self.x - other.x
        made.y = self.y - other.y
        made.z = self.z - other.z
        return made

    def __neg__(self) -> Vector3:
        made = Vector3()
        made.x = -self.x
        made.y = -self.y
        made.z = -self.z
        return made

    def __rmul__(self, factor: float) -> Vector3:
        made = Vector3()
        made.x = factor * self.x
        made.y = factor * self.y
        made.z = factor * self.z
        return made

    def __mul__(self, factor: float | Vector3) -> Vector3:
        made = Vector3()
        if factor.__class__ is Vector3:
            made.x = self.x * factor.x  # type: ignore[union-attr]
            made.y = self.y * factor.y  # type: ignore[union-attr]
            made.z = self.z * factor.z  # type: ignore[union-attr]
        elif isinstance(factor, Vector):
            raise TypeError(f"a vector of 3 times one of {len(factor)}")
        else:
            made.x = self.x * factor  # type: ignore[assignment, operator]
            made.y = self.y * factor  # type: ignore[assignment, operator]
            made.z = self.z * factor  # type: ignore[assignment, operator]
        return made

    def __truediv__(self, divisor: float | Vector3) -> Vector3:
        made = Vector3()
        if divisor.__class__ is Vector3:
            made.x = self.x / divisor.x  # type: ignore[union-attr]
            made.y = self.y / divisor.y  # type: ignore[union-attr]
            made.z = self.z / divisor.z  # type: ignore[union-attr]
        else:
            made.x = self.x / divisor  # type: ignore[assignment, operator]
            made.y = self.y / divisor  # type: ignore[assignment, operator]
            made.z = self.z / divisor  # type: ignore[assignment, operator]
        return made


class Vector4(Vector):
    """Four floats: a quaternion, scalar first, or what else there are four of."""

    __slots__ = ("w", "x", "y", "z")
    w: float
    x: float
    y: float
    z: float

    def elements(self) -> tuple[float, float, float, float]:
        return self.w, self.x, self.y, self.z

    def __getitem__(self, k: Any) -> Any:
        part = (self.w, self.x, self.y, self.z)[k]
        return vector(*part) if part.__class__ is tuple else part  # type: ignore[misc]

    def __add__(self, other: Vector4) -> Vector4:
        if other.__class__ is not Vector4:
            return NotImplemented
        made = Vector4()
        made.w = self.w + other.w
        made.x = self.x + other.x
        made.y = self.y + other.y
        made.z = self.z + other.z
        return made

    def __sub__(self, other: Vector4) -> Vector4:
        if other.__class__ is not Vector4:
            return NotImplemented
        made = Vector4()
        made.w = self.w - other.w
        made.x = self.x - other.x
        made.y = self.y - other.y
        made.z = self.z - other.z
        return made

    def __neg__(self) -> Vector4:
        made = Vector4()
        made.w = -self.w
        made.x = -self.x
        made.y = -self.y
        made.z = -self.z
        return made

    def __rmul__(self, factor: float) -> Vector4:
        made = Vector4()
        made.w = factor * self.w
        made.x = factor * self.x
        made.y = factor * self.y
        made.z = factor * self.z
        return made

    def __mul__(self, factor: float | Vector4) -> Vector4:
        made = Vector4()
        if factor.__class__ is Vector4:
            made.w = self.w * factor.w  # type: ignore[union-attr]
            made.x = self.x * factor.x  # type: ignore[union-attr]
            made.y = self.y * factor.y  # type: ignore[union-attr]
            made.z = self.z * factor.z  # type: ignore[union-attr]
        elif isinstance(factor, Vector):
            raise TypeError(f"a vector of 4 times one of {len(factor)}")
        else:
            made.w = self.w * factor  # type: ignore[assignment, operator]
            made.x = self.x * factor  # type: ignore[assignment, operator]
            made.y = self.y * factor  # type: ignore[assignment, operator]
            made.z = self.z * factor  # type: ignore[assignment, operator]
        return made

    def __truediv__(self, divisor: float | Vector4) -> Vector4:
        made = Vector4()
        if divisor.__class__ is Vector4:
            made.w = self.w / divisor.w  # type: ignore[union-attr]
            made.x = self.x / divisor.x  # type: ignore[union-attr]
            made.y = self.y / divisor.y  # type: ignore[union-attr]
            made.z = self.z / divisor.z  # type: ignore[union-attr]
        else:
            made.w = self.w / divisor  # type: ignore[assignment, operator]
            made.x = self.x / divisor  # type: ignore[assignment, operator]
            made.y = self.y / divisor  # type: ignore[assignment, operator]
            made.z = self.z / divisor  # type: ignore[assignment, operator]
        return made


VECTORS: dict[int, type[Vector]] = {2: Vector2, 3: Vector3, 4: Vector4}  # by size


def vector(first: float, second: float, third: float | None = None, fourth: float | None = None) -> Any:
    """The vector of two, three or four components."""
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
