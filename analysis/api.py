"""What a Python program calls: one flight, one campaign, one study of stability."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from .batch.results import BatchResult
from .batch.runner import run_batch
from .campaign.plan import read_plan
from .errors import InputError, suggestion
from .flight.interruptible import fly
from .flight.results import Result
from .flight.simulation import Simulation
from .stability.ask.request import read_request
from .stability.results.report import StabilityReport
from .stability.study import study
from .system.faults import Fault
from .system.options import SystemOptions
from .system.parameter_sets import ParameterValue
from .system.prepared import prepare_system


def simulate(
    system: str | Path,
    *,
    use: Mapping[str, str] | None = None,
    parameters: Sequence[str] = (),
    set: Mapping[str, ParameterValue] | None = None,
    faults: Sequence[Fault] = (),
    **options: Any,
) -> Result:
    """Fly a system once.

    ``system`` is a name under ssp_systems, a folder or an .ssp; ``use`` maps components to FMUs
    (block names or paths), ``parameters`` lists parameter sets, ``set`` maps
    ``component.variable`` to values in SI units. Further options are those of `SystemOptions`
    (step, stop_time in s, algorithm, variant, flavour, allow_unmatched, no_feedthrough).
    Raises InputError; a flight that fails comes back with its ``status``.
    """
    prepared = prepare_system(system, _options(use, parameters, set, options))
    with Simulation(prepared, faults=faults) as simulation:
        return fly(simulation)


def batch(
    system: str | Path,
    campaign: str,
    *,
    compare: Mapping[str, Sequence[str]] | None = None,
    trials: int | None = None,
    seed: int | None = None,
    workers: int | None = None,
    output: str | Path | None = None,
    use: Mapping[str, str] | None = None,
    parameters: Sequence[str] = (),
    set: Mapping[str, ParameterValue] | None = None,
    faults: Sequence[Fault] = (),
    **options: Any,
) -> BatchResult:
    """Fly a campaign, by name or path of its .toml file; see docs/campaigns.md.

    ``compare`` maps slots to the FMUs flown there on the same draws; ``output`` is a folder for
    trials.parquet, draws.parquet and summary.json; ``faults`` fly in every trial, after the campaign's own. The rest
    is as in `simulate`. Raises InputError.
    """
    plan = read_plan(
        system,
        campaign,
        _options(use, parameters, set, options),
        trials=trials,
        seed=seed,
        compare=compare,
        faults=faults,
    )
    folder = Path(output) if output is not None else None
    result = run_batch(plan, workers=workers, output=folder)
    if folder is not None:
        result.write(folder)
    return result


def stability(
    system: str | Path,
    *,
    loops: Sequence[str] = (),
    at: float | None = None,
    campaign: str | None = None,
    trials: int | None = None,
    seed: int | None = None,
    trial: int | None = None,
    workers: int | None = None,
    use: Mapping[str, str] | None = None,
    parameters: Sequence[str] = (),
    set: Mapping[str, ParameterValue] | None = None,
    **options: Any,
) -> StabilityReport:
    """Margins, poles and robustness of a system's loops; see docs/stability.md.

    ``loops`` are names that the system declares (all of them by default), or connectors to cut as
    ``component.connector`` at the time ``at`` (s). ``campaign`` disperses the margins over its trials; ``trial``
    studies the draws of one of them instead. The rest is as in `simulate`. Raises InputError, and
    StudyError where a flight that the study needs breaks off.
    """
    request = read_request(
        system,
        _options(use, parameters, set, options),
        loops=loops,
        at=at,
        campaign=campaign,
        trials=trials,
        seed=seed,
        trial=trial,
    )
    return study(request, workers)


def _options(
    use: Mapping[str, str] | None,
    parameters: Sequence[str],
    settings: Mapping[str, ParameterValue] | None,
    options: Mapping[str, Any],
) -> SystemOptions:
    if isinstance(parameters, str):
        raise InputError("parameters", parameters, "one name where a list is meant", f'give ["{parameters}"]')
    known = [field.name for field in fields(SystemOptions)]
    for name in options:
        if name not in known:
            raise InputError("options", name, "no such option", suggestion(name, known))
    return SystemOptions(use=dict(use or {}), parameters=tuple(parameters), set=dict(settings or {}), **options)
