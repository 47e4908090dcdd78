"""Lower bounds on the propellant of a campaign's trials: `perilune.bound_trials`, `perilune design bounds`."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Unpack

import numpy as np

from ...common.atomic import write_atomically
from ...common.errors import InputError, UnwrittenError
from ...common.progress import progress_bar
from ..campaigns.definition.checks import check_draws, lookup_constants, prepare_variants
from ..campaigns.definition.plan import BatchPlan, read_plan
from ..campaigns.draws.lookup import InputColumns, Lookup, LookupTable, input_hashes
from ..campaigns.execute.workers import worker_count
from ..commands.campaigns import campaign_name
from ..design.trajectories.descent_problem import check_roles, descent_problem
from ..design.trajectories.many_bounds import INTERVALS, bound_descents
from ..documents.model import Document
from ..documents.of.design.trial_bounds import trial_bounds_document
from ..options.command import write_command
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.ssp.archive import SystemArchive
from ..runtime.system.options import SystemOptions
from .common.documented import Documented
from .common.stores import check_stored_system
from .options.design import BOUNDS, BoundsOptions

LOOKUP = "bound"  # name of the lookup computed here
DECIMALS = {"propellant": 6, "duration": 2}  # of the columns of the lookup's table, in kg and s


@dataclass(frozen=True, eq=False)
class TrialBounds(Documented):
    """Lower bounds on the propellant of all trials of a ``campaign``.

    ``propellant`` (kg) and ``duration`` (s) of the bounding descent are arrays (trials,), NaN where no descent exists.
    ``intervals`` is the number of intervals of the discretisation, and ``file`` is the stored table, if requested.
    """

    campaign: str
    propellant: np.ndarray
    duration: np.ndarray
    intervals: int
    file: Path | None = None

    def document(self) -> Document:
        """Return a document with mean and range of the bounds, and the file of the stored table."""
        return trial_bounds_document(**vars(self))

    def problems(self) -> list[str]:
        """Return a line about trials without a bound, if any."""
        missing = np.flatnonzero(~np.isfinite(self.propellant))
        if not missing.size:
            return []
        return [f"{missing.size} trials (the first is {missing[0]}) cannot reach the target within any duration"]


@verb(BOUNDS)
def bound_trials(system: FilePath, campaign: FilePath, **options: Unpack[BoundsOptions]) -> TrialBounds:
    """Compute a lower bound on the propellant of every trial of a campaign: `perilune design bounds`.

    Needs the extra `plan`. The campaign declares the inputs of the bound in [lookup.bound.inputs]; see
    docs/planning.md. ``workers`` does not affect the numbers. ``store`` writes the table that [lookup.bound] reads.
    Raises InputError.
    """
    plan = read_plan(os.fspath(system), os.fspath(campaign), SystemOptions(), trials=options["trials"])
    lookup = _find_lookup(plan)
    count, intervals = worker_count(options["workers"]), options["intervals"] or INTERVALS
    inputs, archive = _inputs_of(plan, lookup)
    file = _target(lookup, archive) if options["store"] else None
    bounded = replace(_solve(inputs, lookup, intervals, count), campaign=campaign_name(plan), file=file)
    if file is not None:
        written = {"trials": options["trials"], "intervals": options["intervals"], "store": True}
        command = write_command(BOUNDS, {"system": plan.system, "campaign": bounded.campaign}, written)
        texts = {name: ", ".join(formula.text for formula in row) for name, row in lookup.inputs.items()}
        columns = {"propellant": bounded.propellant, "duration": bounded.duration}
        try:
            file.parent.mkdir(exist_ok=True)
            write_atomically(file, LookupTable(columns, input_hashes(inputs), texts, command).write(DECIMALS))
        except OSError as error:
            raise UnwrittenError(error, bounded) from error
    return bounded


def _find_lookup(plan: BatchPlan) -> Lookup:
    for lookup in plan.campaign.lookups:
        if lookup.name == LOOKUP:
            return lookup
    problem = "the campaign does not declare the inputs of its trials' bounds"
    raise InputError(
        plan.campaign.file, f"lookup.{LOOKUP}", problem, f'add [lookup.{LOOKUP}]; see "Planning" in the documentation'
    )


def _inputs_of(plan: BatchPlan, lookup: Lookup) -> tuple[InputColumns, SystemArchive]:
    """Return the bound's inputs of all trials, and the system. Raises InputError, also if variants differ in inputs."""
    where = _element_of(lookup)
    check_roles({name: len(formulas) for name, formulas in lookup.inputs.items()}, where)
    plan = replace(plan, campaign=replace(plan.campaign, lookups=(), metrics=()))  # the lookup's table may be missing
    systems = prepare_variants(plan)
    check_draws(plan, systems.values())
    table = plan.draws.of_part(range(plan.campaign.trials))
    (first, inputs), *others = (
        (variant, lookup.input_columns({**lookup_constants(plan, system, lookup), **table.columns}, table.trials))
        for variant, system in systems.items()
    )
    for variant, other in others:
        if input_hashes(other) != input_hashes(inputs):
            problem = f"the inputs of {variant} differ from those of {first}"
            raise InputError(*where, problem, "use parameters with the same values in all variants")
    return inputs, next(iter(systems.values())).archive


def _solve(inputs: InputColumns, lookup: Lookup, intervals: int, workers: int) -> TrialBounds:
    """Compute the bounds of all trials, in parallel. Raises InputError."""
    trials = range(next(iter(inputs.values()))[0].size)
    numbers = ({name: [x[trial] for x in row] for name, row in inputs.items()} for trial in trials)
    problems, masses = zip(*(descent_problem(each, _element_of(lookup)) for each in numbers), strict=True)
    bounds = []
    with progress_bar(total=len(trials), unit="trial") as progress:
        for bound in bound_descents(problems, intervals, workers):
            bounds.append(bound)
            progress.update()
    fractions, durations = np.array(bounds).T
    return TrialBounds("", fractions * np.array(masses), durations, intervals)


def _element_of(lookup: Lookup) -> tuple[str, str]:
    return lookup.origin, f"{lookup.element}.inputs"


def _target(lookup: Lookup, archive: SystemArchive) -> Path:
    """Return the path of a lookup's table. Raises InputError if it cannot be written."""
    inside = archive.name_of(lookup.origin)
    if inside is None:
        return Path(lookup.label)
    check_stored_system(archive)
    origin = archive.files[inside]
    assert isinstance(origin, Path)  # the archive is a folder
    return Path(os.path.normpath(origin.parent / lookup.file))
