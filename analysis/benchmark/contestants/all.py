"""All contestants, in the order of the table."""

from __future__ import annotations

from functools import partial

from . import fmpy_calls, fmpy_ssp, fmucontainer, fused_limit, libcosim, perilune_loop
from .contestant import Contestant

WAYS = (
    Contestant(
        "fmpy_simulate_ssp",
        "python",
        "FMPy's simulate_ssp: one call per variable, every connector recorded",
        None,
        fmpy_ssp.prepare,
    ),
    Contestant(
        "libcosim_threads",
        "python",
        "libcosim with a worker thread, as it comes on two processors",
        "jacobi",
        partial(libcosim.prepare, threads=1),
    ),
    Contestant(
        "libcosim",
        "python",
        "libcosim in its fastest configuration, without worker threads",
        "jacobi",
        libcosim.prepare,
    ),
    Contestant(
        "fmucontainer",
        "python",
        "one FMU made by fmucontainer, stepped by FMPy",
        "jacobi",
        fmucontainer.prepare,
    ),
    Contestant(
        "fmucontainer_sequential",
        "python",
        "the same, exchanging after each FMU in the order of the SSD",
        "sequential",
        partial(fmucontainer.prepare, sequential=True),
    ),
    Contestant(
        "fmpy_calls",
        "python",
        "FMPy's calls in a hand-written loop: one setReal, doStep, getReal per FMU",
        "sequential",
        fmpy_calls.prepare,
    ),
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


def _native(way: Contestant) -> Contestant:
    name = f"{way.name.removesuffix('_python')}_native"
    return Contestant(name, "native", way.what, way.algorithm, way.prepare)


FUSED = Contestant(
    "fused_limit",
    "native",
    "the blocks of the native FMUs fused into one compiled function without FMI: what the loop could cost at best",
    "sequential",
    fused_limit.prepare,
    exact=True,
)
CONTESTANTS = (*WAYS, *(_native(way) for way in WAYS), FUSED)
# What the others are compared with, by flavour.
OURS = {"python": "perilune_python", "native": "perilune_native"}
