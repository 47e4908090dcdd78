"""The three studies flown once for all tests of their pages."""

import pytest

from tests.support.pages.studies import rare_study, sensitivity_study, worst_study


@pytest.fixture(scope="session")
def rare_result(tmp_path_factory):
    return rare_study(tmp_path_factory.mktemp("rare"))


@pytest.fixture(scope="session")
def worst_result(tmp_path_factory):
    return worst_study(tmp_path_factory.mktemp("worst"))


@pytest.fixture(scope="session")
def sensitivity_result(tmp_path_factory):
    return sensitivity_study(tmp_path_factory.mktemp("sensitivity"))
