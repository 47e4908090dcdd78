"""Choice of a batch's simulations whose signals over time are inside its page, and of their rows."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ....campaigns.execute.campaign_result import CampaignResult
from ....runtime.flight.results import Flight
from ...common.colours import look
from ...scene.flights import RecordedFlight
from ...scene.view import FlightName

FLIGHT_LIMIT = 40  # simulations in a page, of all variants together
ROW_LIMIT = 500  # rows of a simulation


def choose_flights(batch: CampaignResult) -> dict[str, list[int]]:
    """Return trials with recorded signals by variant, each with an equal quota of `FLIGHT_LIMIT`.

    Up to half of a quota are failures, the others successes; each group is in order of trial.
    """
    quota = max(1, FLIGHT_LIMIT // len(batch.rows))
    chosen: dict[str, list[int]] = {}
    for variant, rows in batch.rows.items():
        success = _success_by_trial(batch, variant)
        traced = [trial for trial in rows.traced() if trial in success]
        failed = [trial for trial in traced if not success[trial]]
        succeeded = [trial for trial in traced if success[trial]]
        failures = failed[: max(quota // 2, quota - len(succeeded))]
        chosen[variant] = sorted([*failures, *succeeded[: quota - len(failures)]])
    return {variant: trials for variant, trials in chosen.items() if trials}


def read_flights(
    batch: CampaignResult, chosen: dict[str, list[int]], names: Collection[str]
) -> tuple[list[RecordedFlight], int]:
    """Read some signals of the chosen trials, every ``stride``-th row and the last; return them and the stride.

    The stride is common to all, so times coincide except at the end. Trials that ended before their first sample are
    omitted.
    """
    traces = {}
    for variant, trials in chosen.items():
        success = _success_by_trial(batch, variant)
        for trial in trials:
            trace = batch.rows[variant].trace(trial, names)
            if trace is not None and trace["time"].size:
                traces[FlightName(variant, trial, not success[trial])] = trace
    stride = max((-(-trace["time"].size // ROW_LIMIT) for trace in traces.values()), default=1)
    colours = {variant: look(index).colour for index, variant in enumerate(batch.rows)}
    flights = [
        RecordedFlight(
            name,
            f"trial {name.trial}" if len(batch.rows) == 1 else f"{name.variant}, trial {name.trial}",
            colours[name.variant],
            _thin(trace, stride),
        )
        for name, trace in traces.items()
    ]
    return flights, stride


def _thin(trace: dict[str, np.ndarray], stride: int) -> Flight:
    last = trace["time"].size - 1
    rows = np.unique(np.append(np.arange(0, last, stride), last))
    signals = {name: values[rows].astype(float) for name, values in trace.items()}
    return Flight(signals.pop("time"), signals, {}, "", "")


def _success_by_trial(batch: CampaignResult, variant: str) -> dict[int, bool]:
    sample = batch.plotted[variant]
    return dict(zip(sample.dots.trial.tolist(), sample.dots.success.tolist(), strict=True))
