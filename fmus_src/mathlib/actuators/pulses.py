"""Pulses about three axes that start at the same instant, with signed lengths (s). Kernel functions."""

from ..vectors import Vector3, vector


def next_switch_off(pulses: Vector3, time: float, end: float) -> float:
    """Return the time (s from the start of the pulses) of the next end of a pulse after ``time``, at most ``end``."""
    first = end
    for i in range(3):
        length = abs(pulses[i])
        if length > time and length < first:
            first = length
    return first


def limit_pulse(length: float, h: float) -> float:
    """Return the signed length (s) that remains of one pulse after h (s)."""
    if length > h:
        return length - h
    if length < -h:
        return length + h
    return 0.0


def left_after(pulses: Vector3, h: float) -> Vector3:
    """Return the signed lengths (s) that remain of the pulses after h (s)."""
    return vector(limit_pulse(pulses.x, h), limit_pulse(pulses.y, h), limit_pulse(pulses.z, h))


def lengths_of(pulses: Vector3) -> Vector3:
    """Return the magnitudes of the signed lengths (s)."""
    return vector(abs(pulses.x), abs(pulses.y), abs(pulses.z))
