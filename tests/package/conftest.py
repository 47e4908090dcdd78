"""The wheel, built and installed once for all tests here."""

from __future__ import annotations

import os

import pytest

from tests.support.installed import Installed, build_wheel, install, installed_in
from tests.support.locks import one_process_at_a_time


@pytest.fixture(scope="session")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "installed"
    with one_process_at_a_time(folder.with_name("installed.lock")):
        if not (folder / "home").is_dir():  # the last that is made
            install(build_wheel(folder / "wheel"), folder)
    return installed_in(folder)
