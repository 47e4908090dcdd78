"""Declarations of a cross-check, in the words of a verification report."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Case:
    """A flight that both codes simulate, with the steps (s) that are compared: each, and half of it.

    ``quantities`` are the columns that belong together, by name and unit; ``bounds`` the largest difference that counts
    as agreement, by name, in that unit.
    """

    title: str
    verifies: str
    gravitation: str
    environment: str
    integrator: str
    matched: str
    step: float
    duration: float
    quantities: dict[str, tuple[str, tuple[str, ...]]]
    bounds: dict[str, float]


def vector(name: str, size: int = 3) -> tuple[str, ...]:
    """Return the columns of a vector's elements."""
    return tuple(f"{name}[{index + 1}]" for index in range(size))


POSITION = ("m", vector("position"))
VELOCITY = ("m/s", vector("velocity"))
ATTITUDE = ("rad", vector("quaternion", 4))  # compared by the angle between both
RATE = ("rad/s", vector("rate"))
MASS = ("kg", ("mass",))
WHEEL_SPEED = ("rad/s", vector("wheel_speed", 4))
