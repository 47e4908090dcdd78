"""The ways of simulating a system that `perilune benchmark` times: this project's loop and FMPy."""

from __future__ import annotations

from functools import partial

from . import fmpy_calls, fmpy_ssp, perilune_loop
from .contestant import Contestant, both_flavours

FMPY_SSP = Contestant(
    "fmpy_simulate_ssp",
    "python",
    "FMPy's simulate_ssp: one call per variable, every connector recorded",
    None,
    fmpy_ssp.prepare,
)
FMPY_CALLS = Contestant(
    "fmpy_calls",
    "python",
    "FMPy's calls in a hand-written loop: one setReal, doStep, getReal per FMU",
    "sequential",
    fmpy_calls.prepare,
)
LOOPS = (
    Contestant(
        "perilune_jacobi_python",
        "python",
        "the compiled loop of this project, exchanging after all have stepped",
        "jacobi",
        partial(perilune_loop.prepare, algorithm="jacobi"),
    ),
    Contestant(
        "perilune_python",
        "python",
        "the compiled loop of this project",
        "sequential",
        perilune_loop.prepare,
    ),
)
CONTESTANTS = both_flavours(FMPY_SSP, FMPY_CALLS, *LOOPS)
MODULE = __name__
# What the others are compared with, by flavour.
OURS = {"python": "perilune_python", "native": "perilune_native"}
