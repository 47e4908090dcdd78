"""Truths of navigation."""

from tests.support.checks.navigation import lunar, monitors, passing
from tests.support.checks.navigation.attitude_filter import attitude_filter
from tests.support.checks.navigation.translation_filter import translation_filter

TRUTHS = {
    **lunar.TRUTHS,
    **monitors.TRUTHS,
    **passing.TRUTHS,
    "attitude_filter": attitude_filter,
    "translation_filter": translation_filter,
}
