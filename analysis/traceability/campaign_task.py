"""Simulation task written from a campaign's folder: requirements, samples, systems, trials, verdicts."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

from ...common.atomic import write_atomically
from ...fmus_src.evidence.manifest import mime_type
from ..campaigns.execute.campaign_result import CampaignResult
from ..campaigns.folder.campaign_manifest import (
    CONTENTS,
    FILE,
    CampaignDocument,
    CampaignManifest,
    SourceDocument,
    read_manifest,
)
from ..campaigns.folder.shard_files import DRAWS, FOLDER, SUMMARY
from ..commands.campaigns import campaign_command
from .elements import Task

PARQUET, JSON = mime_type(DRAWS), mime_type(SUMMARY)
KINDS = {".fmu": "model", ".ssd": "system", ".ssv": "parameter", ".ssm": "parameter", ".ssb": "parameter"}


def write_task(result: CampaignResult, path: Path) -> None:
    """Write the simulation task of a finished campaign that has a folder to ``path`` (.stmd). Raises OSError."""
    assert result.folder is not None  # the option has no effect without one
    folder, campaign = result.folder.absolute(), result.plan.campaign
    manifest = read_manifest(folder)
    title = f"{manifest.system['name']}: {Path(campaign.file.rpartition('/')[2]).stem}"
    task = Task(title, f"Perilune {version('perilune')}", path)

    requirements = task.step("RequirementsPhase", "DefineTestCaseRequirements")
    for label, content in _sources(manifest.campaign):
        requirements.add_file("Output", folder / CONTENTS / content, "requirement", "application/toml", label)
    requirements.classify("org.perilune.success", {"success": campaign.success.text})
    requirements.classify("org.perilune.requirements", {each.name: str(each) for each in campaign.requirements})

    parameters = task.step("ImplementationPhase", "ImplementParameter")
    parameters.add_file("Output", folder / DRAWS, "parameter", PARQUET, "draws, a row for each trial")
    parameters.classify("org.perilune.draws", {"seed": str(campaign.seed), "trials": str(campaign.trials)})

    environment = task.step("ImplementationPhase", "IntegrateSimulation")
    for label, content in _system_files(manifest):
        kind = KINDS.get(Path(label).suffix.lower(), "document")
        environment.add_file("Output", folder / CONTENTS / content, kind, mime_type(label), label)
    environment.add_file("Output", folder / FILE, "configuration", JSON, "all that the numbers depend on")

    execution = task.step("ExecutionPhase", "ExecuteSimulation")
    for name in (DRAWS, FILE):
        execution.add_file("Input", folder / name, "configuration", mime_type(name), name)
    for variant in campaign.variants():
        execution.add_text("Procedure", campaign_command(result.plan, variant), "method", f"variant {variant.name}")
    for part, description in ((FOLDER, "trials"), ("traces", "recorded flights")):
        for file in sorted((folder / part).rglob("*.parquet")):
            label = f"{description}: {file.relative_to(folder).as_posix()}"
            execution.add_file("Output", file, "result", PARQUET, label)

    evaluation = task.step("EvaluationPhase", "EvaluateSimulationResults")
    evaluation.add_file("Output", folder / SUMMARY, "report", JSON, "rates, statistics and verdicts")
    rates = {
        variant: f"{entry.success_rate:.10g} of {entry.trials} trials" for variant, entry in result.summary.items()
    }
    evaluation.classify("org.perilune.success_rate", rates)

    verdicts = {
        f"{variant}.{name}": f"{each.verdict}: {each.text}; {each.failures} failures in {each.flights} trials"
        for variant, entry in result.summary.items()
        for name, each in entry.requirements.items()
    }
    decision = task.step("FulfillmentPhase", "DecideSimulationObjectiveFulfillment")
    decision.add_file("Input", folder / SUMMARY, "report", JSON, SUMMARY)
    decision.classify("org.perilune.verdicts", verdicts)
    write_atomically(path, task.write())


def _sources(campaign: CampaignDocument | SourceDocument) -> Iterator[tuple[str, str]]:
    """Yield label and content of a campaign's file, and of the files that it extends."""
    yield campaign["label"].rpartition("/")[2], campaign["content"]
    for extended in campaign.get("extends", ()):
        yield from _sources(extended)


def _system_files(manifest: CampaignManifest) -> Iterator[tuple[str, str]]:
    """Yield name and content of each file of the system, and of each external FMU and parameter set."""
    yield from manifest.system["files"].items()
    for key, content in manifest.elsewhere.items():
        kind, _, name = key.partition(":")
        is_fmu = kind in ("source", "use") and not name.lower().endswith(".fmu")
        yield f"{name}.fmu" if is_fmu else name, content
    for table in (manifest.series, manifest.draws):
        if table is not None:
            yield table["label"].rpartition("/")[2], table["content"]
