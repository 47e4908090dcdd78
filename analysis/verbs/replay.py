"""`perilune.replay`: repetition of a trial with all signals, from its campaign's folder or from its system."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import chdir
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack

from ...common.errors import InputError
from ..campaigns.execute.replay import ReplayedTrial, replay_plan, replay_trial
from ..campaigns.plain_text import faults_line
from ..commands.campaigns import replay_command, replay_of_folder
from ..documents.figures.figure_reader import read_figures
from ..documents.of.batch.printed import outcome_lines
from ..documents.of.simulation.run import RunContext
from ..options.command import record_options
from ..options.declared.campaigns import REPLAY, ReplayOptions
from ..options.option import FilePath
from ..options.simulation_options import TrustOptions
from ..options.verb import verb
from ..runtime.flight.interruptible import StuckError
from ..runtime.system.options import select_permissions
from .common.arguments import read_requirements
from .common.campaign_options import read_campaign
from .run import STUCK, Result

METRIC = "metric."
SYSTEM_JUDGES = "the system's description"
OF_A_FOLDER = {
    "configuration",
    "log",
    "timeout",
    "require",
    *TrustOptions.__annotations__,
}  # options that are permitted with a campaign's folder


@dataclass(repr=False, kw_only=True)
class ReplayResult(Result):
    """A trial of a campaign simulated again with every signal; see `Result` for its members, plots and page.

    ``replayed`` is the trial within its campaign: ``configuration``, outcome, faults, and differences from the stored
    trial. There are no differences on the machine that simulated the campaign.
    """

    replayed: ReplayedTrial
    source: str

    @property
    def configuration(self) -> str:
        """The variant of the campaign."""
        return self.replayed.configuration

    @property
    def trial(self) -> int:
        """The number of the trial."""
        return self.replayed.trial

    @property
    def success(self) -> bool:
        """True if the trial meets the campaign's success condition."""
        return self.replayed.outcome.success

    @property
    def metrics(self) -> dict[str, float]:
        """The campaign's metrics of this trial, by name."""
        return self.replayed.outcome.metrics

    @property
    def stored(self) -> bool:
        """True if the folder contains the trial."""
        return self.replayed.stored

    @property
    def differences(self) -> tuple[str, ...]:
        """The differences from the stored trial, a line each."""
        return self.replayed.differences

    def context(self) -> RunContext:
        """Return the context of the document: system, command, and the trial of the campaign."""
        context = super().context()
        title = f"{self.system}, {self.configuration}, trial {self.trial}"
        return replace(context, title=title, draw_diagram=None, lines=[*context.lines, *self._lines()])

    def to_json(self) -> dict[str, object]:
        """Return the JSON of `Result` with campaign, success, metrics and differences of the trial added."""
        metrics = {name: value if abs(value) < float("inf") else None for name, value in self.metrics.items()}
        faults = {"faults": list(self.replayed.faults)} if self.replayed.plan.fault_texts() else {}
        return (
            super().to_json()
            | faults
            | {
                "campaign": self.replayed.plan.campaign.file,
                "trial": self.trial,
                "configuration": self.configuration,
                "success": self.success,
                "metrics": metrics,
                "stored": self.stored,
                "differences": list(self.differences),
            }
        )

    def _lines(self) -> list[str]:
        """Return lines on the trial, which the terminal shows after the lines of the simulation."""
        metrics = self.replayed.plan.campaign.metrics
        lines = outcome_lines(self.configuration, self.trial, self.replayed.outcome, metrics)
        lines += [faults_line(self.replayed.faults)] if self.replayed.faults else []
        if self.stored and not self.differences:
            lines.append("identical to the stored trial, bit for bit")
        return lines

    def problems(self) -> list[str]:
        """Return the problems of `Result`, a missed success, and differences from the stored trial."""
        name, lines = f"{self.source}: trial {self.trial}", super().problems()
        success = self.replayed.plan.campaign.success.text
        if self.complete and not self.success:
            lines.append(f"{name}: not a success: {success} is not met")
        elif self.complete and lines:
            judges = " and ".join([SYSTEM_JUDGES, *(["`require`"] if self.requirements else [])])
            lines.append(
                f"{name}: a success of the campaign, since {success} is met; the lines above come from {judges}"
            )
        remedy = "; the campaign ran with another version of Perilune, or foreign FMUs on another machine"
        return lines + [f"{name}: {each}{'' if self.replayed.is_cut_off else remedy}" for each in self.differences]

    def last_values(self) -> dict[str, float]:
        """Return the last values of time and signals, and the metrics, for requirements."""
        return super().last_values() | {METRIC + name: value for name, value in self.metrics.items()}


@verb(REPLAY)
def replay(source: FilePath, trial: int, **options: Unpack[ReplayOptions]) -> ReplayResult:
    """Repeat a trial of a campaign, identical to the last bit and with all signals: `perilune replay`.

    ``source`` is a folder of `batch`, or with ``campaign`` a system; ``configuration`` selects a variant if there are
    several. ``timeout`` (s, wall clock) replaces the timeout of the campaign. Other options are as in `batch` and apply
    to a system only, since a folder defines its own. Raises InputError, and TimeoutError if a step of an FMU does not
    return.
    """
    with chdir(Path.cwd()):  # an FMU may change the folder
        try:
            replayed = _replay(source, trial, options)
        except StuckError as error:
            raise StuckError(f"{source}: trial {trial}: {error}; {STUCK}") from error
    result = ReplayResult.extending(
        replayed.flight,
        prepared=replayed.prepared,
        figures=tuple(read_figures(replayed.prepared)),
        replayed=replayed,
        source=str(source),
        command=_command(source, replayed, of_folder=options["campaign"] is None),
    )
    result.requirements = tuple(read_requirements(options["require"], result.last_values()))
    return result


def _command(source: FilePath, replayed: ReplayedTrial, *, of_folder: bool) -> str:
    variants = {variant.name: variant for variant in replayed.plan.campaign.variants()}
    if of_folder:
        return replay_of_folder(Path(source), variants, replayed.configuration, replayed.trial)
    return replay_command(replayed.plan, variants[replayed.configuration], replayed.trial)


def _replay(source: FilePath, trial: int, options: Mapping[str, Any]) -> ReplayedTrial:
    if options["campaign"] is not None:
        plan = read_campaign(source, options["campaign"], options)
        return replay_plan(plan, trial, options["configuration"])
    for name in record_options(ReplayOptions, options):
        if name not in OF_A_FOLDER:
            problem = "a campaign's folder already determines this option"
            raise InputError(f"`{name}`", "", problem, f"leave out `{name}`, or give a system and `campaign`")
    watch = {name: options[name] for name in ("log", "timeout")}
    return replay_trial(Path(source), trial, options["configuration"], trust=select_permissions(options), **watch)
