"""Flights one behind another, without a return to the interpreter between them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from numba import typeof

from ....common.compiler import compile_cached
from . import loop
from .arrays import Recording, Span
from .codes import FINISHED, STOP_TIME
from .loop import under_another_name


def _fly_group(program, buffers, settings, span, recording, excitation, fmi3, fused, group):  # type: ignore[no-untyped-def]
    """Fly the flights of ``group`` from their start; returns how many have flown.

    Ends early behind a flight that did not come to its end. The record has room for all.
    """
    end = recording.offset
    reset = span.reset
    for flight in range(group.ends.size):
        for column in range(group.real_position.size):
            settings.real[group.real_position[column]] = group.real[flight, column]
        for column in range(group.whole_position.size):
            settings.whole[group.whole_position[column]] = group.whole[flight, column]
        for fault in range(group.fault_value.shape[1]):
            program.fault_window[fault, 0] = group.fault_window[flight, fault, 0]
            program.fault_window[fault, 1] = group.fault_window[flight, fault, 1]
            program.fault_value[fault] = group.fault_value[flight, fault]
        end = fly(  # type: ignore[name-defined]  # noqa: F821
            program,
            buffers,
            settings,
            Span(reset, span.start, span.step, span.stop, span.first, span.last),
            Recording(recording.slots, recording.stride, recording.record, recording.times, end),
            excitation,
            fmi3,
            fused,
        )
        group.ends[flight] = end
        group.endings[flight] = buffers.outcome[0]
        if buffers.outcome[0] != STOP_TIME and buffers.outcome[0] != FINISHED:
            return flight + 1
        reset = True
    return group.ends.size


@cache
def _function(*, locked: bool, with_fused: bool) -> Any:
    fly = loop.function(locked=locked, with_fmi3=False, with_fused=with_fused)
    name = f"_fly_group{'' if locked else '_unlocked'}{'_fused' if with_fused else ''}"
    return compile_cached(under_another_name(_fly_group, globals(), name, fly=fly), nogil=not locked)


def compile_for(arguments: tuple, *, locked: bool, with_fused: bool) -> Callable[..., int]:
    """The function for arguments of these types, of systems without FMI 3.0; choices as in `loop.compile_for`."""
    return _function(locked=locked, with_fused=with_fused).compile(tuple(typeof(part) for part in arguments))
