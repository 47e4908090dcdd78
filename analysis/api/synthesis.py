"""The search for a control law from Python."""

from __future__ import annotations

import os
from pathlib import Path

from ..synthesis.outcome import SynthesisResult
from ..synthesis.synthesis import run_synthesis
from ..synthesis.synthesis_file import named_search, read_synthesis
from .options import FilePath


def synthesize(
    search: FilePath,
    *,
    seed: int | None = None,
    workers: int | None = None,
    output: FilePath | None = None,
    resume: bool = False,
    evaluations: int | None = None,
) -> SynthesisResult:
    """Search for a law of a network operator, every candidate flown: `perilune synthesize network-operator`.

    ``search`` is a name of laws/searches/ or the path of a campaign with what to search for; ``output`` a folder for
    checkpoints, Pareto set and law, from which ``resume`` goes on; the search ends with the generation in which
    ``evaluations`` laws have flown. Whether a law was found is the result's ``succeeded``. Raises InputError.
    """
    return run_synthesis(
        read_synthesis(named_search(os.fspath(search))),
        seed=seed,
        workers=workers,
        output=None if output is None else Path(output),
        resume=resume,
        evaluations=evaluations,
    )
