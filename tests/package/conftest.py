"""The wheel, built and installed once for all tests here."""

from __future__ import annotations

import pytest

from tests.support.installed import Installed, build_wheel, install, installed_in
from tests.support.locks import made_once


@pytest.fixture(scope="session")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    return installed_in(
        made_once(tmp_path_factory, "installed", lambda folder: install(build_wheel(folder / "wheel"), folder))
    )
