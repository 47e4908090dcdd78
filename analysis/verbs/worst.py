"""`perilune.worst`: the worst case of a metric or of a stability margin within a campaign's dispersions."""

from __future__ import annotations

import os
from contextlib import chdir
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Unpack

from ..campaigns.definition.plan import BatchPlan
from ..commands.stability import study_command
from ..documents.model import Document
from ..documents.of.studies.worst import simulate_worst, worst_document
from ..options.declared.studies import WORST, WorstOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.system.options import system_options
from ..studies.flown import StudyCommands
from ..studies.worst import outcome
from ..studies.worst.margin_request import MarginRequest, check_options, request_margin
from ..studies.worst.worst_search import MARGIN, worst_case, worst_margin
from .common.arguments import read_requirements
from .common.campaign_options import commands_of, read_campaign
from .common.studies import Conditions, RequirementResult, conditions, results_folder, store_result

NUMBERS = ("worst", "random", "fresh_worst", "fresh_quantile", "flights")  # numbers to which requirements may refer


@dataclass(frozen=True, eq=False, repr=False)
class WorstResult(RequirementResult, outcome.WorstOutcome):
    """Result of a worst-case search: ``worst`` and ``worst_random`` trial, and every simulation in ``flown``.

    ``plan`` is the simulated plan, None for a stability margin. ``folder`` stores the result, if requested.
    """

    plan: BatchPlan | None = None

    def document(self) -> Document:
        """Return a document with worst case, conditions, search, random trials and box.

        Its page simulates the worst case.
        """
        simulate = None if self.plan is None else partial(simulate_worst, self, self.plan)
        return worst_document(self, self.folder, simulate)

    def write(self, folder: FilePath) -> None:
        """Write worst.json, flights.parquet and worst.parquet."""
        super().write(Path(folder))


class SearchConditions(Conditions, total=False):
    """Conditions of a worst-case search."""

    sigmas: float
    realisations: int | None
    quantile: float | None
    flights: int


@verb(WORST)
def worst(system: FilePath, campaign: FilePath, **options: Unpack[WorstOptions]) -> WorstResult:
    """Search for the worst case of a metric within a box of a campaign's dispersions: `perilune worst`.

    ``metric`` is an expression over metrics and sampled inputs that grows as the case gets worse; default: the margin
    to the success condition. With ``loop`` the objective is the smallest stability ``margin`` (default: disk margin) of
    a loop that the system declares, at its operating ``point``, or of a connector to cut at the time ``at`` (s). An
    unstable loop is worse than any margin; ``compare``, ``faults``, ``input``, ``log`` and ``timeout`` exclude
    ``loop``.

    ``sigmas`` bounds normal inputs; others have their full range. ``flights`` is the number of simulations, by default
    2000, or 500 for a margin. If components have noise, every point is simulated with the same ``realisations`` of the
    noise (by default 5, or 1 for a margin), and the search maximises the ``quantile`` (default: 0.5, the median) over
    them; the worst point is simulated again with ten times as many new realisations. ``hold``, ``noise_trial`` and
    ``compare`` are as in `rare`; ``output`` is a folder for worst.json, flights.parquet and worst.parquet; ``require``
    lists expressions over worst, random, fresh_worst, fresh_quantile and flights. Other options are as in `batch`.
    Raises InputError.
    """
    folder = results_folder(options)
    loop = options["loop"]
    check_options(loop, options)
    requirements = read_requirements(options["require"], NUMBERS)
    search: SearchConditions = {
        **conditions(options),
        "sigmas": options["sigmas"],
        "realisations": options["realisations"],
        "quantile": options["quantile"],
    }
    if options["flights"] is not None:
        search["flights"] = options["flights"]
    plan = None
    with chdir(Path.cwd()):  # an FMU may change the folder
        if loop is None:
            plan = read_campaign(system, campaign, options)
            result = replace(worst_case(plan, options["metric"], **search), commands=commands_of(plan))
        else:
            request = request_margin(
                os.fspath(system),
                system_options(options),
                campaign=str(campaign),
                configuration=options["configuration"],
                loop=loop,
                point=options["point"],
                at=options["at"],
                seed=options["seed"],
            )
            result = replace(
                worst_margin(request, options["margin"] or MARGIN, **search), commands=_commands_of_margin(request)
            )
    return store_result(WorstResult, result, folder, plan=plan, requirements=requirements)


def _commands_of_margin(search: MarginRequest) -> StudyCommands:
    """Return functions that write the commands of a worst-margin search's studies."""

    def replay(draws: Path, trial: int) -> str:
        return study_command(replace(search.request, draws=draws), search.loop.name, trial)

    return StudyCommands(replay)
