"""`perilune.synthesize` and `perilune design search`: a search for a network operator's law."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Unpack

from ..common.targets import check_folder
from ..design.synthesis.outcome import SynthesisResult
from ..design.synthesis.synthesis import run_synthesis
from ..design.synthesis.synthesis_file import find_search, read_synthesis
from .options.design import SEARCH, SearchOptions
from .options.option import FilePath
from .options.verb import verb


@verb(SEARCH)
def synthesize(search: FilePath, **options: Unpack[SearchOptions]) -> SynthesisResult:
    """Search for a law of a network operator, every candidate simulated: `perilune design search`.

    ``search`` is a name of laws/searches/ or the path of a campaign that says what to search for; ``output`` a folder
    for checkpoints, Pareto set and law, from which ``resume`` continues; the search ends with the generation in which
    ``evaluations`` laws have been evaluated. The result's ``succeeded`` says whether the chosen law has every trial a
    success. Raises InputError.
    """
    folder = None if options["output"] is None else Path(options["output"])
    check_folder("`output`", folder, overwrite=options["resume"], otherwise="`resume` to continue")
    result = run_synthesis(
        read_synthesis(find_search(os.fspath(search))),
        seed=options["seed"],
        workers=options["workers"],
        output=folder,
        resume=options["resume"],
        evaluations=options["evaluations"],
    )
    result.folder = folder
    return result
