"""The ratios that the project promises, from the times of one run."""

from __future__ import annotations

from collections.abc import Mapping

from .times import Times

# Time per step of the first over that of the second.
PROMISED = (
    ("perilune_native", "fused_limit"),
    ("fmpy_simulate_ssp", "perilune_native"),
    ("fmucontainer_native", "perilune_native"),
    ("fmpy_simulate_ssp", "perilune_python"),
)


def promised_ratios(times: Mapping[str, Times], trials: Mapping[str, Mapping[str, float]]) -> dict[str, float]:
    """Ratios by ``first/second``, of those that flew; for the workers trials per second, by flavour."""
    found = {
        f"{slow}/{fast}": times[slow].ratio(times[fast]) for slow, fast in PROMISED if slow in times and fast in times
    }
    for flavour, rates in trials.items():
        found[f"two_workers/one_worker_{flavour}"] = rates["2"] / rates["1"]
    return found
