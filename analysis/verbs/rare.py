"""`perilune.rare`: the probability of a rare failure."""

from __future__ import annotations

from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Unpack

from ..documents.model import Document
from ..documents.of.studies.rare import rare_document
from ..options.declared.studies import RARE, RareOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..studies.rare import outcome
from ..studies.rare.study import rare_failure
from .common.arguments import read_requirements
from .common.campaign_options import commands_of, read_campaign
from .common.studies import RequirementResult, conditions, results_folder, store_result

NUMBERS = ("probability", "interval[1]", "interval[2]", "flights")  # numbers to which requirements may refer


@dataclass(frozen=True, eq=False, repr=False)
class RareResult(RequirementResult, outcome.RareOutcome):
    """Result of a rare-failure study: ``probability``, ``interval``, ``failures`` among ``flights`` simulations.

    ``simulation`` contains the levels, ``flown`` contains every simulation; ``folder`` stores the result, if requested.
    """

    def document(self) -> Document:
        """Return a document with probability, interval, levels, and design points with their conditions."""
        return rare_document(self, self.folder)

    def write(self, folder: FilePath) -> None:
        """Write rare.json and flights.parquet, and failures.parquet if there are failures."""
        super().write(Path(folder))


@verb(RARE)
def rare(system: FilePath, campaign: FilePath, **options: Unpack[RareOptions]) -> RareResult:
    """Estimate the probability of a rare failure over a campaign's dispersions and noise: `perilune rare`.

    The method is subset simulation. ``failure`` is an expression over metrics and sampled inputs; by default every
    trial that is not a success is a failure. ``samples`` is the number of simulations per level; the search ends once a
    failure is less probable than ``least``. ``hold`` fixes dispersed inputs.

    Noise of components is random, unless ``noise_trial`` selects the noise of one trial of the campaign for all
    simulations: the probability is then conditional on this realisation. ``compare`` selects the FMU of a slot that the
    campaign compares. ``output`` is a folder for rare.json, flights.parquet and failures.parquet; ``require`` lists
    expressions over probability, interval[1], interval[2] and flights. Other options are as in `batch`. Raises
    InputError.
    """
    folder = results_folder(options)
    requirements = read_requirements(options["require"], NUMBERS)
    plan = read_campaign(system, campaign, options)
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = rare_failure(
            plan, options["failure"], samples=options["samples"], least=options["least"], **conditions(options)
        )
    result = replace(result, commands=commands_of(plan))
    return store_result(RareResult, result, folder, requirements=requirements)
