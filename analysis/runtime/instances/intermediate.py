"""The callback that FMI 3.0 FMUs call within their steps: compiled, since it may be called without Python's lock."""

from __future__ import annotations

from functools import cache

from numba import carray, cfunc, types

from ...common.compiler import compile_cached

SIGNATURE = types.void(
    types.voidptr,
    types.float64,
    types.uint8,
    types.uint8,
    types.uint8,
    types.uint8,
    types.CPointer(types.uint8),
    types.CPointer(types.float64),
)


def _ignore(_environment, _time, _set, _get, _finished, _can_return, requests_return, _return_time):  # type: ignore[no-untyped-def]
    """Nothing is exchanged between communication points, and no early return is wanted."""
    carray(requests_return, 1)[0] = 0


@cache
def ignore_address() -> int:
    """The address of the callback, a fmi3IntermediateUpdateCallback."""
    return int(compile_cached(_ignore, lambda **options: cfunc(SIGNATURE, **options)).address)
