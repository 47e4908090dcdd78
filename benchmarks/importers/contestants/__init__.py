"""Compared importers: Perilune's loop, FMPy, libcosim, fmucontainer, and the fused limit."""

from functools import partial

from ..contestant import Contestant, both_flavours
from . import fmucontainer, fused_limit, libcosim
from .loop_and_fmpy import FMPY_CALLS, FMPY_SSP, FUSED_STEPS, LOOPS

WAYS = (
    FMPY_SSP,
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
    FMPY_CALLS,
    *LOOPS,
)
FUSED_LIMIT = Contestant(
    "fused_limit",
    "native",
    "the blocks of the native FMUs fused into one compiled function without FMI: what the loop could cost at best",
    "sequential",
    fused_limit.prepare,
    exact=True,
)
CONTESTANTS = (*both_flavours(*WAYS), FUSED_STEPS, FUSED_LIMIT)
