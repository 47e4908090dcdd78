"""Functions of vectors of three components. Kernel functions; no particular frame is assumed."""

import math

from ..kernel.vector_types import Vector, Vector2, Vector3, Vector4, vector

__all__ = [
    "Vector",
    "Vector2",
    "Vector3",
    "Vector4",
    "across",
    "add_along",
    "all_below",
    "clip",
    "cross",
    "dot",
    "finite_or_zero",
    "is_finite",
    "limit_length",
    "norm",
    "smallest_component",
    "vector",
]


def dot(a: Vector3, b: Vector3) -> float:
    """Return the scalar product."""
    return a.x * b.x + a.y * b.y + a.z * b.z


def norm(a: Vector3) -> float:
    """Return the Euclidean length."""
    return math.sqrt(a.x * a.x + a.y * a.y + a.z * a.z)


def cross(a: Vector3, b: Vector3) -> Vector3:
    """Return the vector product a x b."""
    return vector(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)


def across(a: Vector3, direction: Vector3) -> Vector3:
    """Return the component of the vector a perpendicular to a unit vector."""
    return a - dot(a, direction) * direction


def limit_length(a: Vector3, longest: float) -> Vector3:
    """Return the vector shortened to ``longest`` if it is longer."""
    length = norm(a)
    if length > longest:
        return longest / length * a
    return a


def is_finite(a: Vector3) -> bool:
    """Return True if all components are finite."""
    return math.isfinite(a.x) and math.isfinite(a.y) and math.isfinite(a.z)


def finite_or_zero(a: Vector3) -> Vector3:
    """Return the vector, or 0 if a component is not finite."""
    if is_finite(a):
        return a
    return vector(0.0, 0.0, 0.0)


def all_below(v: Vector, limit: float) -> bool:
    """Return True if the magnitude of every component is below a limit; False if a component is NaN."""
    below = True
    for i in range(len(v)):
        below = below and abs(v[i]) < limit
    return below


def smallest_component(a: Vector3) -> tuple[int, float]:
    """Return index and value of the first component of least magnitude, which names the axis farthest from the
    vector.
    """
    k = 0
    for i in range(3):
        if abs(a[i]) < abs(a[k]):
            k = i
    return k, a[k]


def add_along(a: Vector3, k: int, amount: float) -> Vector3:
    """Return the vector with ``amount`` added to component k (0 to 2)."""
    if k == 0:
        return vector(a.x + amount, a.y, a.z)
    if k == 1:
        return vector(a.x, a.y + amount, a.z)
    return vector(a.x, a.y, a.z + amount)


def clip(value: float, low: float, high: float) -> float:
    """Return the value limited to the range from low to high."""
    if value < low:
        return low
    if value > high:
        return high
    return value
