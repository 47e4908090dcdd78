"""Execution of a synthesis: evaluator, search, checkpoints, results."""

from __future__ import annotations

import math
from importlib.metadata import version
from pathlib import Path

import numpy as np

from ....common.errors import InputError, suggestion
from ....common.progress import progress_bar
from ...campaigns.definition.checks import check_plan
from ...campaigns.definition.plan import BatchPlan
from ...campaigns.execute.flyer import Flyer
from ...campaigns.execute.workers import worker_count
from ...campaigns.folder.shard_files import write_draws
from ...runtime.system.prepared import PreparedSystem
from ..laws.law import law_parameters
from .checkpoint import read_checkpoint, write_checkpoint
from .fitness import VARIANT, FlightEvaluator
from .genetic import Search, SearchState
from .synthesis_file import Synthesis
from .synthesis_outcome import SynthesisOutcome, write_log

CHECKPOINT = "checkpoint.json"


def run_synthesis(
    synthesis: Synthesis,
    *,
    seed: int | None = None,
    workers: int | None = None,
    output: Path | None = None,
    resume: bool = False,
    evaluations: int | None = None,
) -> SynthesisOutcome:
    """Search for laws. Raises InputError before any simulation.

    ``seed`` replaces the campaign's; ``workers`` is the number of laws evaluated in parallel (default: one per
    processor) and does not change the result. With ``output``, a checkpoint from which ``resume`` continues is written
    there after every generation, and the results at the end. The search ends with the generation in which the number of
    evaluated laws reaches ``evaluations``.
    """
    output = None if output is None else output.absolute()  # FMUs may change the working folder
    count = worker_count(workers)
    if evaluations is not None and evaluations < 1:
        raise InputError("`evaluations`", str(evaluations), "not a positive number", "give 1 or more")
    checkpoint = _checkpoint(output, resume)
    plan = synthesis.plan(seed)
    prepared = _check(synthesis, plan)
    facts = provenance(synthesis, plan, prepared)
    stored = {name: fact for name, fact in facts.items() if name != "campaign"}  # the file may have moved
    code = synthesis.settings.coding.encode(synthesis.basic.q)
    random = np.random.Generator(np.random.PCG64(plan.campaign.seed))
    state = SearchState(random=random, bases=[synthesis.basic.matrix], code=code)
    if resume and checkpoint is not None:
        state = read_checkpoint(checkpoint, stored)
    elif output is not None:
        write_draws(plan, output, plan.campaign.trials)
    objectives = tuple(synthesis.objectives.values())
    with (
        progress_bar(initial=state.evaluations, unit="law") as progress,
        FlightEvaluator(
            plan,
            synthesis.component,
            synthesis.basic,
            objectives,
            workers=count,
            native=prepared.flies_in_threads,
            evaluated=progress.update,
        ) as evaluator,
    ):
        search = Search(synthesis.settings, evaluator, state)
        limit = math.inf if evaluations is None else evaluations
        while not state.population or not (search.is_over or state.evaluations >= limit):
            search.advance()
            if checkpoint is not None:
                write_checkpoint(checkpoint, state, stored)
                write_log(checkpoint.with_name("log.csv"), synthesis, search)
            summary = f"{state.history[-1]['successes']} of {evaluator.trials} trials are successes"
            progress.set_postfix_str(f"generation {state.generation}, {summary}")
    reason = "success" if state.succeeded else "generations" if search.is_over else "evaluations"
    result = SynthesisOutcome(synthesis, search, facts, reason)
    if output is not None:
        result.write(output)
    return result


def _checkpoint(output: Path | None, resume: bool) -> Path | None:
    """Return the path of the checkpoint, None without ``output``.

    Raises InputError if a checkpoint would be overwritten, or if there is no folder for ``resume``.
    """
    if output is None:
        if resume:
            raise InputError("`resume`", "", "no folder to resume from", "give `output`")
        return None
    path = output / CHECKPOINT
    if path.exists() and not resume:
        raise InputError(
            path, "", "the folder already contains a search", "give `resume` to continue it, or another `output`"
        )
    return path


def _check(synthesis: Synthesis, plan: BatchPlan) -> PreparedSystem:
    """Return the prepared system, after checking that the component accepts a law."""
    without_law = BatchPlan(plan.system, plan.campaign, plan.options, plan.campaign_sha256)
    prepared = check_plan(without_law)[VARIANT]
    fmus, component = prepared.network.fmus, synthesis.component
    where = (plan.campaign.file, "network_operator.component")
    if component not in fmus:
        raise InputError(*where, f"no component {component} in the system", suggestion(component, fmus))
    for name in plan.overlaid:
        if name.removeprefix(f"{component}.") not in fmus[component].variables:
            problem = f"{component} is an FMU {fmus[component].name}, which has no parameter {name}"
            raise InputError(*where, problem, 'name the FMU of a network operator with fmu = "..."')
    prepared = check_plan(plan)[VARIANT]
    _simulate_basic_law(synthesis, plan)
    return prepared


def _simulate_basic_law(synthesis: Synthesis, plan: BatchPlan) -> None:
    """Simulate the basic solution once, since a system that cannot run with it could not run with any law."""
    flyer = Flyer(plan)
    try:
        result = flyer.fly_one(VARIANT, 0, law_parameters(synthesis.basic, synthesis.component))
    finally:
        flyer.close()
    if result.message:
        problem = f"the first simulation of the basic solution failed: {result.message}"
        raise InputError(plan.campaign.file, "trial 0", problem, "correct step, parameters or system")


def provenance(synthesis: Synthesis, plan: BatchPlan, prepared: PreparedSystem) -> dict[str, object]:
    """Return the inputs that determine the result."""
    return {
        "system": prepared.archive.name,
        "system_sha256": prepared.archive.digest,
        "campaign": plan.campaign.file,
        "campaign_sha256": plan.campaign_sha256,
        "seed": plan.campaign.seed,
        "component": synthesis.component,
        "basic_solution": synthesis.basic.content(),
        "start_time": prepared.start,
        "step": prepared.step,
        "steps": prepared.steps,
        "fmus": {name: fmu.digest for name, fmu in prepared.network.fmus.items()},
        "perilune": version("perilune"),
    }
