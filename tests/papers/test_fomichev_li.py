"""Published comparison of Fomichev and Li (2017), and results here.

Truth: the published table, as data below; binomial bounds at 99.9 % around rates reproduced with independent code;
bounds on the errors of the exact method from its derivation. The paper's errors depend on an unspecified step, so only
rates are compared.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy import stats

import perilune

SYSTEM = "lunar_terminal_guidance"
CONFIDENCE = 0.999
TRIALS = 300
EXACT_TRIALS = 100
pytestmark = pytest.mark.usefixtures("fmus")


@dataclass(frozen=True)
class Published:
    """A row of the table: success in %, miss distance (m) and velocity (m/s) as mean and standard deviation."""

    success: float
    miss: tuple[float, float]
    velocity: tuple[float, float]
    trials: int = 10_000


TABLE = {
    "analytic_guidance": Published(100.0, (0.4456, 0.2883), (0.4390, 0.2336)),
    "astar_guidance": Published(82.9, (0.4568, 0.6455), (1.0196, 1.2049)),
    "astar_modified_guidance": Published(93.5, (2.2596, 6.6021), (1.3355, 1.5896)),
}
# Success rates (%) that the published ones and those reproduced lie in.
BANDS = {
    "analytic_guidance": (100.0, 100.0),
    "astar_guidance": (82.0, 87.0),
    "astar_modified_guidance": (92.0, 95.0),
}


def successes_within(low, high, trials):
    """Return fewest and most successes of ``trials`` that a rate (%) between low and high leaves likely."""
    tail = (1.0 - CONFIDENCE) / 2.0
    return stats.binom.ppf(tail, trials, low / 100.0), stats.binom.ppf(1.0 - tail, trials, high / 100.0)


@pytest.fixture(scope="module")
def result(fmus):
    return perilune.batch(SYSTEM, "paper", trials=TRIALS, workers=1)


@pytest.mark.parametrize("method", TABLE)
def test_success_rates(result, method):
    low, high = BANDS[method]
    assert low <= TABLE[method].success <= high
    fewest, maximum = successes_within(low, high, TRIALS)
    reached = round(result.summary[method].success_rate * TRIALS)
    assert fewest <= reached <= maximum


def test_methods_rank_as_published(result):
    """On the same draws: what the analytic method reaches is at least what the others do."""
    rates = [result.summary[method].success_rate for method in sorted(TABLE, key=lambda name: TABLE[name].success)]
    assert rates == sorted(rates)


def test_errors_of_the_stop_at_the_last_full_cycle(result):
    """The time left unflown is uniform on (0, h); over it thrust would have taken away the velocity left."""
    rows = [row for row in result.table().to_pylist() if row["variant"] == "analytic_guidance"]
    left = np.array([row["final.guidance.time_to_go"] for row in rows])
    assert stats.kstest(left / 0.1, stats.uniform(0, 1).cdf).pvalue > 1e-3
    actual = result.summary["analytic_guidance"].metrics
    assert actual["velocity_error"].mean == pytest.approx(0.27, abs=0.05)
    assert actual["velocity_error"].std == pytest.approx(0.16, abs=0.03)
    assert actual["position_error"].mean == pytest.approx(0.009, abs=0.003)


@pytest.mark.parametrize(("step", "miss", "velocity"), [(0.1, 1e-6, 1e-3), (1.0, 1e-3, 0.05)])
def test_exact_method_meets_the_target(step, miss, velocity):
    compare = {"guidance": ["analytic_exact_guidance"]}
    actual = perilune.batch(
        SYSTEM, "paper", trials=EXACT_TRIALS, compare=compare, parameters=["exact.ssv"], step=step, workers=1
    ).summary["analytic_exact_guidance"]
    assert actual.success_rate == 1.0
    assert actual.metrics_all["position_error"].count == EXACT_TRIALS
    assert actual.metrics_all["position_error"].max < miss
    assert actual.metrics_all["velocity_error"].max < velocity
