"""What drives a campaign's metrics, from Python."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import chdir
from dataclasses import replace
from pathlib import Path
from typing import Literal

from ...sensitivity import study
from ...sensitivity.outcome import SensitivityResult
from ...ssp.parameter_sets import SetValue
from ...system.faults import Fault
from ...system.in_flight.series import Given
from ...targets import check_folder
from ..options import FilePath
from .plans import commands_of, sample_plan


def sensitivity(
    system: FilePath,
    campaign: FilePath,
    base: int,
    *,
    hold: Mapping[str, float] | None = None,
    noise_trial: int | None = None,
    compare: Mapping[str, str] | None = None,
    seed: int | None = None,
    workers: int | None = None,
    output: FilePath | None = None,
    overwrite: bool = False,
    use: Mapping[str, FilePath] | None = None,
    parameters: Sequence[FilePath] = (),
    set: Mapping[str, SetValue] | None = None,
    faults: Sequence[Fault | str] = (),
    input: Given | None = None,
    log: Literal["error", "warning", "info", "all"] | None = None,
    timeout: float | None = None,
    step: float | None = None,
    stop_time: float | None = None,
    algorithm: Literal["sequential", "jacobi"] | None = None,
    variant: str | None = None,
    flavour: Literal["native", "python"] | None = None,
    allow_unmatched: bool = False,
    strict: bool = False,
    open_inputs: Literal["refuse", "start"] = "refuse",
    feedthrough: Sequence[str] = (),
    no_feedthrough: Sequence[str] = (),
) -> SensitivityResult:
    """Sobol' indices of a campaign's metrics and of its success: `perilune batch --sensitivity`.

    ``base`` is a power of two: that many times the number of draws and 3 are flown, or the number of draws and 2 where
    no noise is random. The noise of all components is one input beside the draws. Draws that are jointly normal are
    refused. ``hold``, ``noise_trial`` and ``compare`` are as in `rare`; ``output`` is a folder for sensitivity.json,
    flights.parquet and draws.parquet. The rest is as in `batch`. Raises InputError.
    """
    folder = Path(output).absolute() if output is not None else None
    check_folder("output", folder, overwrite=overwrite)
    plan = sample_plan(
        system, campaign, compare=compare, seed=seed, use=use, parameters=parameters, set=set, faults=faults,
        input=input, log=log, timeout=timeout, step=step, stop_time=stop_time, algorithm=algorithm, variant=variant,
        flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
        feedthrough=feedthrough,
        no_feedthrough=no_feedthrough,
    )  # fmt: skip
    with chdir(Path.cwd()):  # an FMU may change the folder
        result = study.sensitivity(plan, base, hold=hold, noise_trial=noise_trial, workers=workers)
    result = replace(result, commands=commands_of(plan))
    if folder is not None:
        result.write(folder)
    return result
