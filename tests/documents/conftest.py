"""Pages that several tests open, each written once: of a run, of batches."""

import pytest

from perilune.analysis.cli import main
from tests.support.locks import made_once


@pytest.fixture(scope="session")
def flight(tmp_path_factory):
    """Write the page of a landing and its table."""

    def fly(folder):
        options = ["--report", str(folder / "page.html"), "--output", str(folder / "flight.parquet")]
        assert main(["run", "landing_mission", *options]) == 0

    return made_once(tmp_path_factory, "landing_mission_page", fly)


@pytest.fixture(scope="session")
def batch(tmp_path_factory):
    """Write a campaign's folder, out, and its page."""

    def fly(folder):
        options = ["--campaign", "paper", "--trials", "300", "--output", str(folder / "out")]
        assert main(["batch", "lunar_terminal_guidance", *options, "--report", str(folder / "page.html")]) == 0

    return made_once(tmp_path_factory, "batch_page", fly)


@pytest.fixture(scope="session")
def recorded(tmp_path_factory):
    """Write a campaign's folder with recorded signals, out, and its page; a failure among its trials."""

    def fly(folder):
        options = [
            "--campaign",
            "compare",
            "--trials",
            "8",
            "--parameters",
            "noisy.ssv",
            "--output",
            str(folder / "out"),
        ]
        assert main(["batch", "lunar_landing", *options, "--report", str(folder / "page.html")]) == 0

    return made_once(tmp_path_factory, "recorded_page", fly)
