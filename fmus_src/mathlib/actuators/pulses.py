"""Pulses about three axes, signed lengths (s) from one instant on. Kernel functions."""

from ..vectors import Vector3, vector


def next_switch_off(pulses: Vector3, time: float, end: float) -> float:
    """Return the time of the first end of a pulse after ``time``, or ``end`` where none is before; s from their
    start."""
    first = end
    for i in range(3):
        length = abs(pulses[i])
        if length > time and length < first:
            first = length
    return first


def limit_pulse(length: float, h: float) -> float:
    """Return the rest of one pulse (s, with its sign) after h (s)."""
    if length > h:
        return length - h
    if length < -h:
        return length + h
    return 0.0


def left_after(pulses: Vector3, h: float) -> Vector3:
    """Return the rest of the pulses (s, with their signs) after h (s)."""
    return vector(limit_pulse(pulses.x, h), limit_pulse(pulses.y, h), limit_pulse(pulses.z, h))


def lengths_of(pulses: Vector3) -> Vector3:
    """Return their lengths without signs (s)."""
    return vector(abs(pulses.x), abs(pulses.y), abs(pulses.z))
