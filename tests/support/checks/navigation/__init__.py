"""Truths of navigation."""

from tests.support.checks.navigation import attitude_navigation, lunar, monitors, orbital_observers, passing
from tests.support.checks.navigation.attitude_filter import attitude_filter
from tests.support.checks.navigation.kalman_navigation import kalman_navigation
from tests.support.checks.navigation.orbital_filter import orbital_filter
from tests.support.checks.navigation.raw_navigation import raw_navigation
from tests.support.checks.navigation.translation_filter import translation_filter

TRUTHS = {
    **attitude_navigation.TRUTHS,
    **lunar.TRUTHS,
    **monitors.TRUTHS,
    **orbital_observers.TRUTHS,
    **passing.TRUTHS,
    "attitude_filter": attitude_filter,
    "kalman_navigation": kalman_navigation,
    "kalman_navigation_filterpy": kalman_navigation,
    "orbital_filter": orbital_filter,
    "raw_navigation": raw_navigation,
    "translation_filter": translation_filter,
}
