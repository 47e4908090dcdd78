"""Pulses about three axes that start at the same instant, with signed lengths (s). Kernel functions."""

from ..vectors import Vector3, vector


def next_switch_off(pulses: Vector3, time: float, end: float) -> float:
    """Return the time of the first end of a pulse after ``time`` and before ``end``, else ``end``; s from the start."""
    first = end
    for i in range(3):
        length = abs(pulses[i])
        if length > time and length < first:
            first = length
    return first


def limit_pulse(length: float, h: float) -> float:
    """Return the remaining signed length (s) of one pulse after h (s)."""
    if length > h:
        return length - h
    if length < -h:
        return length + h
    return 0.0


def left_after(pulses: Vector3, h: float) -> Vector3:
    """Return the remaining signed lengths (s) of the pulses after h (s)."""
    return vector(limit_pulse(pulses.x, h), limit_pulse(pulses.y, h), limit_pulse(pulses.z, h))


def lengths_of(pulses: Vector3) -> Vector3:
    """Return the lengths (s) without signs."""
    return vector(abs(pulses.x), abs(pulses.y), abs(pulses.z))
