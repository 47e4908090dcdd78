"""Pool of simulation workers: results of tasks of any kind.

Truth: the results of the tasks, and the number that ran.
"""

import threading

import pytest

from perilune.analysis.campaigns.definition.plan import read_plan
from perilune.analysis.campaigns.execute.workers import FlyerPool
from perilune.analysis.runtime.system.options import SystemOptions

COUNTED = []
LOCK = threading.Lock()
pytestmark = pytest.mark.usefixtures("fmus")


def doubled(flyer, number):
    return 2 * number, flyer.plan.campaign.trials


def failing(flyer, number, wait):
    """Fail the first task at once; the others wait a little, so that they are not all begun by then."""
    with LOCK:
        COUNTED.append(number)
    if number == 0:
        raise ValueError("the first one")
    wait.wait(0.05)


@pytest.fixture
def plan():
    return read_plan("lunar_terminal_guidance", "paper", SystemOptions(), trials=5)


@pytest.mark.parametrize(("workers", "native"), [(1, True), (2, True), (2, False)])
def test_every_task_once_by_its_place(plan, workers, native):
    with FlyerPool(plan, workers, native) as pool:
        for _ in range(2):  # the pool can be used again
            actual = dict(pool.work(doubled, [(number,) for number in range(20)]))
            assert actual == {number: (2 * number, 5) for number in range(20)}
        assert list(pool.work(doubled, [])) == []


@pytest.mark.parametrize("workers", [1, 2])
def test_an_error_ends_the_rest(plan, workers):
    COUNTED.clear()
    tasks = [(number, threading.Event()) for number in range(200)]
    with FlyerPool(plan, workers, threads=True) as pool, pytest.raises(ValueError, match="the first one"):
        list(pool.work(failing, tasks))
    begun = {1: 1, 2: 199}[workers]  # one worker begins no other task; two have some of the others begun
    assert 1 <= len(COUNTED) <= begun
