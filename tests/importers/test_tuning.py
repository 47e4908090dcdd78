"""Tunable parameters changed by importers during a simulation.

Truth: free fall in closed form with a change of gravity halfway; FMPy, whose bits the other importers reproduce.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from perilune.common.paths import shipped_fmu
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.compilers import local_platform
from tests.support.native.building import fmi3_fmu

from .masters import Flight
from .trial import STEP, STEPS, fly

TUNERS = ("FMPy", "libcosim", "Ecos")
HERE = [name for name in TUNERS if name != "Ecos" or importlib.util.find_spec("ecospy")]
FALL, ORBIT = "flat_moon_lander", "spherical_moon_lander"


def tuned(master: str, fmu: Path, parameter: str, number: float, *outputs: str) -> list[float]:
    """Return the outputs at the end of a flight in which a parameter changes after half of the steps."""
    return list(fly(master, fmu, Flight(STEP, STEPS, outputs, (parameter, number))).values())


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", ["native", "python"])
@pytest.mark.parametrize("master", HERE)
def test_free_fall_with_another_gravity_from_the_middle_on(master: str, flavour: str) -> None:
    before, after, half = 1.62, 3.7, STEP * STEPS / 2.0
    height, speed = tuned(master, shipped_fmu(FALL, flavour), "gravity", after, "position[3]", "velocity[3]")
    assert speed == pytest.approx(-half * (before + after), rel=1e-13)
    assert height - 10500.0 == pytest.approx(-half * half * (1.5 * before + 0.5 * after), rel=1e-11)


@pytest.mark.usefixtures("fmus")
@pytest.mark.skipif(local_platform(3) is None, reason="FMI 3.0 libraries are not compiled for this system")
def test_importers_agree_in_both_versions_of_fmi() -> None:
    """libcosim has no FMI 3.0."""
    two, three = shipped_fmu(ORBIT, "native"), fmi3_fmu(catalogue()[ORBIT])
    flown = [
        tuned(master, fmu, "gravitational_parameter", 7e12, "speed", "altitude")
        for master in HERE
        for fmu in (two, three)
        if (master, fmu) != ("libcosim", three)
    ]
    assert all(each == flown[0] for each in flown[1:])
