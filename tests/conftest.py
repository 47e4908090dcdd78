"""Fixtures of all tests: built FMUs, tiny FMUs, and an end of the process that keeps its exit status."""

from __future__ import annotations

import atexit
import gc
import math
import os
import sys
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import hypothesis
import pytest

from perilune.analysis.cli import main
from perilune.analysis.shipped import main as build_fmus
from perilune.common import progress
from perilune.common.paths import BUILD, shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export import compilers
from perilune.fmus_src.export.closure import closure_of
from tests.support.built import native_are_current, systems_are_current
from tests.support.kernels.programs import NO_QEMU
from tests.support.lengths import LONG, either
from tests.support.locks import made_once, one_process_at_a_time
from tests.support.pages.browser import NO_BROWSER, find_browser
from tests.support.pages.scripts import NO_SCRIPTS
from tests.support.refused import ONE_LINE
from tests.times.memory_disk import use_memory_disk
from tests.times.recording import pytest_runtest_logreport, pytest_runtest_logstart, write_times  # noqa: F401 -- hooks

# The same examples in every run, so that main is not red by chance; `make explore` draws new ones.
hypothesis.settings.register_profile("same", derandomize=True, deadline=None, max_examples=either(100, 25))
hypothesis.settings.register_profile("explore", deadline=None)
hypothesis.settings.load_profile("explore" if os.environ.get("PERILUNE_EXPLORE") == "1" else "same")

_status: list[int] = []


def _leave() -> None:
    """Leave before the destructors of pythonfmu's library, which can crash a process that used it."""
    sys.stdout.flush()
    sys.stderr.flush()
    if _status:
        os._exit(_status[-1])


# Handlers run last in, first out: this one, registered before any test is imported, runs after all others.
atexit.register(_leave)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    _status.append(int(exitstatus))


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    use_memory_disk()
    progress.PERIOD = math.inf  # s; else what a busy machine takes long for had lines that a test does not expect
    config.addinivalue_line("markers", "slow: takes minutes; `make long` runs it")
    config.addinivalue_line("markers", "flies: takes the built FMUs; `make quick` leaves it out")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        if "fmus" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.flies)
    if not LONG:
        for item in items:
            if item.get_closest_marker("slow"):
                item.add_marker(pytest.mark.skip(reason="slow: make long"))


@pytest.hookimpl(trylast=True)
def pytest_collection_finish() -> None:
    """Exempt imported and collected objects from garbage collection: more than half of each full one went over them."""
    gc.freeze()


@pytest.hookimpl(trylast=True)
def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Report in the last lines tests skipped for lack of a browser or an emulator, with the remedy. Times are
    written."""
    write_times(terminalreporter)
    skipped = [str(report.longrepr) for report in terminalreporter.stats.get("skipped", [])]
    for reason, tests, missing, remedy in (
        (NO_BROWSER, "of the HTML pages", "chromium", "Install it (Debian: `make browser` as root)"),
        (NO_QEMU, "of the C on aarch64", "qemu-aarch64", "Install it (Debian: `make emulator` as root)"),
        (NO_SCRIPTS, "of the scripts of pages", "bundle of them", "Run `make web` with access to npm"),
    ):
        if count := sum(reason in each for each in skipped):
            terminalreporter.write_line(
                f"{count} tests {tests} were left out: there is no {missing} here. {remedy} and run `make test` again."
            )


def _is_current(name: str, package: str) -> bool:
    path = shipped_fmu(name, "python")
    if not path.is_file():
        return False
    with zipfile.ZipFile(path) as archive:
        return any(f"/{package}/" in entry for entry in archive.namelist())


def _build_where_old(_: Path) -> None:
    with one_process_at_a_time(BUILD / ".lock"):
        blocks = catalogue()
        native = native_are_current([name for name, block in blocks.items() if not block.python_only])
        python = all(_is_current(name, closure_of(block).package) for name, block in blocks.items())
        if not (native and python and systems_are_current()):
            assert build_fmus([]) == 0


@pytest.fixture
def refusal(request: pytest.FixtureRequest) -> Callable[[list[str]], str]:
    """Return a function that runs `perilune` with arguments, checks that it refuses them with one line and exit
    status 2, and returns that line."""
    captured = request.getfixturevalue("capfd" if "capfd" in request.fixturenames else "capsys")

    def refuse(arguments: list[str]) -> str:
        captured.readouterr()
        status = main(arguments)
        error = captured.readouterr().err
        assert status == 2, (status, error)
        assert ONE_LINE.fullmatch(error), error
        return error

    return refuse


@pytest.fixture(scope="session", autouse=True)
def usual_platforms() -> Iterator[None]:
    """Export for this machine alone where no platform is named: zig first builds a platform's C library, up to a
    minute. `make long` exports for the usual platforms."""
    usual = dict(compilers.USUAL)
    if not LONG:
        local = {fmi: compilers.local_platform(fmi) for fmi in usual}
        compilers.USUAL.update({fmi: (name,) for fmi, name in local.items() if name is not None})
    yield
    compilers.USUAL.update(usual)


@pytest.fixture(scope="session")
def fmus(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of this repository's Python FMUs, built with the native ones if missing or of older sources."""
    made_once(tmp_path_factory, "fmus_looked_at", _build_where_old)
    return shipped_fmu("x", "python").parent


@pytest.fixture(scope="session")
def tiny_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the tiny FMUs of cosim/builders.py in folders `python` and `native`, built once per test run."""
    from tests.support.builders import build_tiny_fmus

    return made_once(tmp_path_factory, "tiny_fmus", build_tiny_fmus)


@pytest.fixture(params=either(["python", "native"], ["native"]))
def tiny(request: pytest.FixtureRequest, tiny_folder: Path) -> Path:
    """Return the tiny FMUs in native flavour, in `make long` in either; some modules take either in any case."""
    return tiny_folder / request.param


@pytest.fixture(scope="session")
def array_fmus(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the FMUs of arrays/fmus.py, native ones."""
    from tests.support.arrays.fmus import build_array_fmus

    return made_once(tmp_path_factory, "array_fmus", build_array_fmus) / "native"


@pytest.fixture(scope="session")
def exact_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the FMUs of stability/exact_blocks.py in folders `python` and `native`, built once per test run."""
    from tests.support.loops.exact_blocks import build_exact_fmus

    return made_once(tmp_path_factory, "exact_fmus", build_exact_fmus)


@pytest.fixture(scope="session")
def exact_fmus(exact_folder: Path) -> Path:
    """Return the native ones."""
    return exact_folder / "native"


@pytest.fixture(scope="session")
def studies(exact_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return reports of tiny systems as `perilune stability` writes them, studied once per test run."""
    from tests.support.loops.studies import keep_studies, kept_studies

    return kept_studies(made_once(tmp_path_factory, "studies", lambda folder: keep_studies(folder, exact_fmus)))


@pytest.fixture(scope="session")
def stability_page(studies: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the page of all these studies at once, written once per test run."""
    from tests.support.pages.written import write_studies

    return made_once(tmp_path_factory, "stability", lambda folder: write_studies(studies, folder)) / "page.html"


@pytest.fixture(scope="session")
def rare_result(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return a rare failure of the linear system, studied once per test run."""
    from tests.support.pages.studies import rare_study

    return rare_study(tmp_path_factory.mktemp("rare"))


@pytest.fixture(scope="session")
def worst_result(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return the worst case of the linear system, studied once per test run."""
    from tests.support.pages.studies import worst_study

    return worst_study(tmp_path_factory.mktemp("worst"))


@pytest.fixture(scope="session")
def sensitivity_result(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return indices of a sum of independent draws, studied once per test run."""
    from tests.support.pages.studies import sensitivity_study

    return sensitivity_study(tmp_path_factory.mktemp("sensitivity"))


@pytest.fixture(scope="session")
def comparison(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a hand-written batch, `quiet`, and the page that compares its
    variants, written once per run."""
    from tests.support.pages.written import write_comparison

    return made_once(tmp_path_factory, "comparison", write_comparison)


@pytest.fixture(scope="session")
def mission_page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the page of a flight through phases, with all figures that a system can declare,
    written once per test run."""
    from tests.support.pages.written import write_mission

    return made_once(tmp_path_factory, "mission", write_mission) / "page.html"


@pytest.fixture(scope="session")
def browser() -> Iterator[str]:
    """Return the path of chromium; at the end quit the browsers that pages shared."""
    yield find_browser()
    from tests.support.pages.driven import quit_browsers

    quit_browsers()
