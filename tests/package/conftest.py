"""The wheel, built and installed once for all tests here."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.installed import Installed, build_wheel, install, remove


@pytest.fixture(scope="session")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Installed]:
    folder = tmp_path_factory.mktemp("installed")
    found = install(build_wheel(folder / "wheel"), folder)
    yield found
    remove(found)
