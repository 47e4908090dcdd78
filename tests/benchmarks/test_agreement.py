"""Agreement of the benchmark's contestants, and time per step. Truth: hand-written values."""

from __future__ import annotations

import math

import pytest

from benchmarks.importers.contestant import Contestant, ExchangeSystem
from benchmarks.importers.times import Times, compute_guaranteed_ratios, disagreements


def contestant(name: str, algorithm: str | None = "sequential", exact: bool = False) -> Contestant:
    def prepare(course: ExchangeSystem):  # type: ignore[no-untyped-def]
        raise NotImplementedError

    return Contestant(name, "native", "", algorithm, prepare, exact)


OURS = contestant("perilune_native")


@pytest.mark.parametrize(
    ("other", "value", "disagrees"),
    [
        (contestant("other"), 1000.0 + 0.5e-6, False),
        (contestant("other"), 1000.0 + 2e-6, True),
        (contestant("other"), math.nan, True),
        (contestant("other", "jacobi"), 7.0, False),  # nothing of ours flew by that algorithm
        (contestant("other", None), 7.0, False),
        (contestant("other", exact=True), 1000.0, False),
        (contestant("other", exact=True), math.nextafter(1000.0, 0.0), True),
    ],
)
def test_disagreements(other: Contestant, value: float, disagrees: bool) -> None:
    final = {"perilune_native": {"x": 1000.0}, "other": {"x": value}}
    assert set(disagreements([OURS, other], final)) == ({"other"} if disagrees else set())


def test_an_exact_contestant_keeps_the_sign_of_zero() -> None:
    final = {"perilune_native": {"x": 0.0}, "other": {"x": -0.0}}
    assert set(disagreements([OURS, contestant("other", exact=True)], final)) == {"other"}


def test_an_exact_contestant_needs_ours() -> None:
    others = [contestant("exact", exact=True), contestant("other")]
    assert set(disagreements(others, {"exact": {"x": 0.0}, "other": {"x": 0.0}})) == {"exact"}


def test_a_step_is_what_the_long_flight_takes_over_the_short_one() -> None:
    ours, theirs = Times(101), Times(101)
    ours.add(short=1.0, long=2.0)
    theirs.add(short=5.0, long=8.0)
    assert ours.step() == pytest.approx(0.01)
    assert ours.start() == pytest.approx(0.99)
    ratios = compute_guaranteed_ratios(
        {"fused_limit": ours, "perilune_native": theirs, "libcosim": ours}, {"native": {"1": 20.0, "2": 38.0}}
    )
    assert ratios == pytest.approx({"perilune_native/fused_limit": 3.0, "two_workers/one_worker_native": 1.9})
