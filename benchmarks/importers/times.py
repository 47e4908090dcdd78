"""Times of simulations and steps, guaranteed ratios, and comparison of values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from statistics import median

from .contestant import Contestant, Values

# Ratios of the times per step of the first and the second contestant.
PROMISED = (
    ("perilune_native", "fused_limit"),
    ("fmpy_simulate_ssp", "perilune_native"),
    ("fmucontainer_native", "perilune_native"),
    ("fmpy_simulate_ssp", "perilune_python"),
)


@dataclass
class Times:
    """Times (s) of simulations of one step and of ``steps`` steps, one entry per repeat."""

    steps: int
    short: list[float] = field(default_factory=list)
    long: list[float] = field(default_factory=list)

    def add(self, short: float, long: float) -> None:
        self.short.append(short)
        self.long.append(long)

    def step(self) -> float:
        """Return the time per step (s), from the fastest simulation of each length."""
        return (min(self.long) - min(self.short)) / (self.steps - 1)

    def median_step(self) -> float:
        """Return the time per step (s), median over the repeats."""
        return median(self._each())

    def start(self) -> float:
        """Return the time (s) from the available files or instances to the first step."""
        return max(0.0, min(self.short) - self.step())

    def ratio(self, other: Times) -> float:
        """Return the ratio of the times per step of two contestants run alternately, the median over repeats."""
        return median(mine / its for mine, its in zip(self._each(), other._each(), strict=True))

    def _each(self) -> list[float]:
        return [(long - short) / (self.steps - 1) for short, long in zip(self.short, self.long, strict=True)]


def compute_guaranteed_ratios(
    times: Mapping[str, Times], trials: Mapping[str, Mapping[str, float]]
) -> dict[str, float]:
    """Return the guaranteed ratios ``first/second`` of available contestants.

    For numbers of workers these are ratios of trials per second, by flavour.
    """
    ratios = {
        f"{slow}/{fast}": times[slow].ratio(times[fast]) for slow, fast in PROMISED if slow in times and fast in times
    }
    for flavour, rates in trials.items():
        ratios[f"two_workers/one_worker_{flavour}"] = rates["2"] / rates["1"]
    return ratios


TOLERANCE = 1e-9


def difference(values: Values, reference: Values) -> float:
    """Return the largest difference, relative to the larger of the reference's magnitude and 1."""
    return max(abs(values[name] - expected) / max(1.0, abs(expected)) for name, expected in reference.items())


def count_differences(values: Values, reference: Values) -> int:
    """Return the number of values that are not equal to the last bit."""
    return sum(values[name].hex() != expected.hex() for name, expected in reference.items())


def disagreements(contestants: Iterable[Contestant], final: Mapping[str, Values]) -> dict[str, str]:
    """Return the contestants that disagree with Perilune's values for the same algorithm, with the reason.

    A contestant declared exact must have been compared.
    """
    by_name = {each.name: each for each in contestants}
    ours = {
        (each.flavour, each.algorithm): final[each.name]
        for each in by_name.values()
        if each.is_ours and each.name in final
    }
    versions: dict[str, str] = {}
    for name, values in final.items():
        reference = ours.get((by_name[name].flavour, by_name[name].algorithm))
        if reference is None:
            if by_name[name].exact:
                versions[name] = "ours did not fly, so that its values cannot be compared"
        elif by_name[name].exact and count_differences(values, reference):
            versions[name] = (
                f"{count_differences(values, reference)} of its values at the end differ from ours in their bits"
            )
        elif not difference(values, reference) <= TOLERANCE:
            versions[name] = f"its values at the end differ from ours by {difference(values, reference):.2g}"
    return versions
