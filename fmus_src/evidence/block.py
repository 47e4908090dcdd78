"""Evidence of a block's FMU: check, recorded outputs, page, and digests of all files."""

from __future__ import annotations

from collections.abc import Mapping

from ..block import Block
from .check import TIME, Check, Tolerances, elements_of, read_check
from .experiments import Experiment, write_experiments
from .manifest import CSV, EXPERIMENTS, FOLDER, PARAMETERS, Related, add_manifest
from .page import block_page
from .parameter_set import write_parameter_set
from .recorded import of_type, record_outputs

CHECK, OUTPUTS, SET, EXPERIMENT = "check.csv", "outputs.csv", "check.ssv", "check.exp"
PAGE = "documentation/index.html"


def add_evidence(block_class: type[Block], files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files of a block's FMU with its evidence added.

    The outputs for the check are recorded only for blocks with the same results on every processor, which Python
    libraries do not guarantee. Raises CheckError for a check that does not fit the block.
    """
    page = Related(PAGE, "document", "text/html", "what the block computes, its variables, its source")
    complete = {**files, PAGE: block_page(block_class)}
    related = [page]
    check = read_check(block_class)
    if check is not None:
        added, roles = _check_files(block_class, check)
        complete |= added
        related += roles
    return add_manifest(complete, related)


def _check_files(block_class: type[Block], check: Check) -> tuple[dict[str, bytes], list[Related]]:
    elements = elements_of(block_class)
    parameters = {name: of_type(elements[name], number) for name, number in check.parameters.items()}
    columns = check.columns()
    stimuli = CHECK if any(elements[name].causality == "input" for name in columns if name != TIME) else None
    times = (columns[TIME][0], check.stop_time)
    files = {CHECK: check.table, SET: write_parameter_set("check", parameters)}
    related = [
        Related(CHECK, "result", CSV, f"inputs, and outputs computed without the block's code: {check.truth}"),
        Related(SET, "parameter", PARAMETERS, "the parameters of check.csv"),
    ]

    def experiment(name: str, description: str, references: str, tolerances: Tolerances) -> Experiment:
        return Experiment(name, description, times, check.step, references, SET, stimuli, tolerances)

    experiments = [experiment("check", "outputs against an independent computation", CHECK, check.tolerances)]
    if not block_class.python_only:
        files[OUTPUTS] = record_outputs(block_class, check)
        related.append(Related(OUTPUTS, "result", CSV, "the FMU's outputs for the inputs of check.csv, all bits"))
        experiments.append(experiment("outputs", "the FMU's outputs, bit by bit", OUTPUTS, {}))
    files[EXPERIMENT] = write_experiments(block_class.fmu_name, experiments)
    related.append(Related(EXPERIMENT, "experiment/validation", EXPERIMENTS, "how to reproduce the trajectories"))
    named = {f"{FOLDER}/{name}": content for name, content in files.items()}
    return named, [Related(f"{FOLDER}/{each.name}", each.role, each.type, each.description) for each in related]
