"""Other importers read exported .ssp files and give the same numbers.

Properties of each importer, found by experiment:

libcosim 0.11.2 (libcosimpy 0.0.6) reads FMUs, connectors and connections of the .ssp. It rejects connections that end
at a connector of the system itself, so these are removed from a copy, and it ignores parameter bindings of a system, so
values are set through its interface. Its fixed-step algorithm is Jacobi: all FMUs get the values of the last exchange,
then all step, then all are read. Before the first step it exchanges values as often as there are FMUs, then leaves
initialisation mode and exchanges once more; this gives the same initial values as one pass of Perilune in the order of
the connections. It counts time in integer nanoseconds, so the times passed to FMUs differ from Perilune's in the last
bit: values agree to 1e-9, but are not equal.

fmucontainer (FMU Manipulation Toolbox 2.0) reads the .ssp unchanged, but without parameter bindings, which are passed
as start values. It initialises in the order of the connections, like Perilune. Its default algorithm is Jacobi; its
sequential algorithm steps in the order of the SSD, which for this system is Perilune's sequential order. Both give
results equal to Perilune's to the last bit.

Every importer runs in a separate process.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from benchmarks.importers.worker import Worker
from perilune.common.paths import SYSTEMS
from perilune.fmus_src.export.ssp_package import pack_system
from tests.support.lengths import either

SYSTEM = "lunar_terminal_guidance"
STEPS = (1, 2, 7, 50, 300)
# Endings of the contestants' names.
FLAVOURS = either({"python": "", "native": "_native"}, {"native": "_native"})

Fly = Callable[[str, int], dict[str, float]]


@pytest.fixture(scope="module", params=FLAVOURS)
def fly(request: pytest.FixtureRequest, fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Fly]:
    """Yield a function from a contestant's name and a number of steps to the values at the end."""
    flavour = request.param
    folder = fmus.with_name(flavour)
    if flavour == "native" and not folder.is_dir():
        pytest.skip("native FMUs are not built")
    ssp = pack_system(SYSTEMS / SYSTEM, [folder], tmp_path_factory.mktemp(flavour))
    with ExitStack() as stack:
        workers: dict[str, Worker] = {}

        def fly(name: str, steps: int) -> dict[str, float]:
            full = f"{name}_{flavour}" if name.startswith("perilune") else f"{name}{FLAVOURS[flavour]}"
            if full not in workers:
                workers[full] = stack.enter_context(Worker(full, ssp))
            return workers[full].ask(steps=steps)["values"]

        yield fly


@pytest.mark.parametrize("steps", STEPS)
@pytest.mark.parametrize("threads", either(["libcosim", "libcosim_threads"], ["libcosim"]))
def test_libcosim_agrees_with_jacobi(fly: Fly, threads: str, steps: int) -> None:
    theirs, ours = fly(threads, steps), fly("perilune_jacobi", steps)
    assert theirs.keys() == ours.keys()
    for name, value in ours.items():
        assert math.isclose(theirs[name], value, rel_tol=1e-9, abs_tol=0.0), name


@pytest.mark.parametrize("steps", STEPS)
@pytest.mark.parametrize(
    ("container", "algorithm"),
    [("fmucontainer", "perilune_jacobi"), ("fmucontainer_sequential", "perilune")],
)
def test_fmucontainer_is_equal(fly: Fly, container: str, algorithm: str, steps: int) -> None:
    assert fly(container, steps) == fly(algorithm, steps)


@pytest.mark.parametrize("steps", STEPS)
def test_calls_by_hand_are_equal(fly: Fly, steps: int) -> None:
    assert fly("fmpy_calls", steps) == fly("perilune", steps)


def test_the_algorithms_differ(fly: Fly) -> None:
    """So that agreement above means agreement in the order of the exchange."""
    assert fly("perilune", 300)["plant.position[1]"] != fly("perilune_jacobi", 300)["plant.position[1]"]
