"""Tunable parameters that change during a simulation: columns of inputs over time, faults.

Truth: FMPy, which drives tunable parameters as it drives inputs; rows computed by hand from the definition of faults
and of the ramp, y(k + 1) = y(k) + slope h, where the step from t uses the slope at t.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

import perilune
from perilune.common.errors import InputError
from perilune.common.paths import CACHE
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.native_fmu import build_native_fmu
from tests.support.builders import component, connection, document, fly, inline, pack, system
from tests.support.kernels.users_blocks import Gains
from tests.support.lone_fmus import build_lone_fmu

STEP, STOP = 0.25, 2.0
RAMP = component("ramp", "ramp", "output y Real m; output flag Boolean; output count Integer")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
SERIES = np.array(
    [(0.0, 0.3, 1.0), (0.5, 2.0, 4.0), (1.1, -1.0, 0.5), (1.6, 0.7, 9.0)],
    dtype=[("time", float), ("damping", float), ("gain", float)],
)


@pytest.fixture(scope="module")
def gains(tmp_path_factory: pytest.TempPathFactory) -> dict[int, Path]:
    """Build the FMUs of a block with tunable parameters, by version of FMI."""
    folder = tmp_path_factory.mktemp("gains")
    platforms = {version: local_platform(version) for version in (2, 3)}
    return {
        version: build_native_fmu(Gains, folder / f"{version}.fmu", platforms=[platform], cache=CACHE, fmi=version)
        for version, platform in platforms.items()
        if platform is not None
    }


def packed(folder: Path, tiny: Path) -> Path:
    text = document(system(RAMP, GAIN, connections=connection("ramp.y", "gain.u")), stop=STOP, step=STEP)
    return pack(folder / "s.ssp", tiny, text)


def ramp(rises: list[float], start: float = 1.0) -> list[float]:
    """Return the ramp from the slope of each step."""
    return np.cumsum([start, *(STEP * slope for slope in rises)]).tolist()


@pytest.mark.parametrize("algorithm", ["sequential", "jacobi"])
def test_a_foreign_fmu_flies_as_fmpy_flies_it(tmp_path: Path, algorithm: str) -> None:
    path = build_lone_fmu("Dynamic", tmp_path)
    series = SERIES[["time", "damping"]]
    options: dict[str, Any] = {"stop_time": STOP, "output_interval": STEP, "step_size": STEP, "output": ["x", "v"]}
    theirs = fmpy.simulate_fmu(str(path), input=series, **options)
    ours = perilune.simulate(path, input=series, step=STEP, stop_time=STOP, algorithm=algorithm)
    for name in ("x", "v"):
        assert ours[f"Dynamic.{name}"].tolist() == theirs[name].tolist()
    assert ours["Dynamic.damping"].tolist() == [0.3] * 2 + [2.0] * 3 + [-1.0] * 2 + [0.7] * 2


@pytest.mark.parametrize("version", [2, 3])
def test_our_fmus_fly_as_fmpy_flies_them(gains: dict[int, Path], version: int) -> None:
    if version not in gains:
        pytest.skip("not compiled for this system")
    series = SERIES[["time", "gain"]].copy()
    series["time"] = [0.0, 0.5, 1.25, 1.75]  # between communication points FMPy adds points
    if version == 2:
        options: dict[str, Any] = {"stop_time": STOP, "output_interval": STEP, "step_size": STEP, "output": ["total"]}
        expected = fmpy.simulate_fmu(str(gains[2]), input=series, **options)["total"].tolist()
    else:  # x = 1, axes 1 and 2, count 1: each step adds its gain and 2
        expected = np.cumsum([3.0, 3.0, 3.0, 6.0, 6.0, 6.0, 2.5, 2.5, 11.0]).tolist()
    ours = perilune.simulate(gains[version], input=series, step=STEP, stop_time=STOP)
    assert ours["gains.total"].tolist() == expected


# kind, amount, and the slope in [0.5, 1.25) s of a ramp of 2 m/s
KINDS = [("override", 5.0, 5.0), ("bias", -0.5, 1.5), ("freeze", 0.0, 2.0)]


@pytest.mark.parametrize(("kind", "amount", "inside"), KINDS)
def test_a_fault_lasts_as_long_as_its_window(
    tiny: Path, tmp_path: Path, kind: str, amount: float, inside: float
) -> None:
    path = packed(tmp_path, tiny)
    fault = perilune.Fault("ramp.slope", kind, amount, 0.5, 1.25)
    rises = [2.0, 2.0, inside, inside, inside, 2.0, 2.0, 2.0]
    flown = fly(path, [fault])
    assert flown.signals["ramp.slope"].tolist() == [*rises, 2.0]
    assert flown.signals["ramp.y"].tolist() == ramp(rises)
    assert flown.signals["gain.y"].tolist() == [3.0 * y for y in ramp(rises)]
    other = fly(path, [fault], set={"ramp.slope": 4.0})
    changed = {"override": 5.0, "bias": 3.5, "freeze": 4.0}[kind]
    assert other.signals["ramp.slope"].tolist() == [4.0, 4.0, changed, changed, changed, 4.0, 4.0, 4.0, 4.0]


def test_a_follower_computes_the_outputs_of_a_time_with_the_parameter_of_then(tiny: Path, tmp_path: Path) -> None:
    """As with its inputs: the gain's factor is 3, and 10 at 0.5 s and 0.75 s."""
    flown = fly(packed(tmp_path, tiny), [perilune.Fault("gain.factor", "override", 10.0, 0.5, 1.0)])
    factors = [3.0, 3.0, 10.0, 10.0, 3.0, 3.0, 3.0, 3.0, 3.0]
    expected = [factor * y for factor, y in zip(factors, ramp([2.0] * 8), strict=True)]
    assert flown.signals["gain.y"].tolist() == expected


def test_whole_numbers_and_booleans(tiny: Path, tmp_path: Path) -> None:
    """The flag is up from step 2 on, then its threshold is out of reach, then it is inverted."""
    faults = [
        perilune.Fault("ramp.flag_at", "override", 2, 0.0, 1.0),
        perilune.Fault("ramp.inverted", "override", True, 1.5),
    ]
    flown = fly(packed(tmp_path, tiny), faults)
    assert flown.signals["ramp.flag"].tolist() == [False, False, True, True, True, False, False, True, True]


def test_fused_steps_have_the_same_bits(tiny_folder: Path, tmp_path: Path) -> None:
    path = packed(tmp_path, tiny_folder / "native")
    faults = [
        perilune.Fault("ramp.slope", "bias", 0.3, 0.5, 1.25),
        perilune.Fault("ramp.flag_at", "override", 2, 0.75),
        perilune.Fault("gain.factor", "freeze", start=0.3),
    ]
    plain, fused = fly(path, faults), fly(path, faults, flavour="fused")
    assert {name: column.tobytes() for name, column in plain.signals.items()} == {
        name: column.tobytes() for name, column in fused.signals.items()
    }


def test_a_column_drives_a_parameter_of_a_component(tiny: Path, tmp_path: Path) -> None:
    series = np.array([(0.0, 1.0), (0.6, 7.0)], dtype=[("time", float), ("ramp.slope", float)])
    flown = perilune.simulate(packed(tmp_path, tiny), input=series)
    rises = [1.0, 1.0, 1.0, 7.0, 7.0, 7.0, 7.0, 7.0]
    assert flown["ramp.y"].tolist() == ramp(rises)
    assert flown.provenance["input"]["signals"] == ["ramp.slope"]


def test_of_a_parameter_that_the_system_gives(tiny_folder: Path, tmp_path: Path) -> None:
    """Closed form: u = 2, y = k u and (k + 1) u."""
    text = document(
        system(
            component("gain", "gain", "parameter factor Real; input u Real m; output y Real m"),
            connections=connection("k", "gain.factor") + connection("u", "gain.u"),
            declared="parameter k Real; input u Real m",
            bindings=inline("k=Real:4; u=Real:2 m"),
        ),
        stop=STOP,
        step=STEP,
    )
    path = pack(tmp_path / "s.ssp", tiny_folder / "native", text)
    flown = fly(path, [perilune.Fault("gain.factor", "bias", 1.0, 0.5, 1.25)])
    assert flown.signals["gain.y"].tolist() == [8.0, 8.0, 10.0, 10.0, 10.0, 8.0, 8.0, 8.0, 8.0]
    recorded = perilune.simulate(path, record=["gain.factor"])
    assert recorded["gain.factor"].tolist() == [4.0] * 9


REFUSED = {
    "start": "a parameter that is fixed after initialisation; set it before the start by set ramp.start=VALUE, or",
    "first_count": "a parameter that is fixed after initialisation; set it before the start by set ramp.first_count=",
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_fixed_parameter_is_refused_with_what_to_do(tiny_folder: Path, tmp_path: Path, name: str) -> None:
    path = packed(tmp_path, tiny_folder / "native")
    with pytest.raises(InputError, match=re.escape(REFUSED[name])):
        fly(path, [perilune.Fault(f"ramp.{name}", "override", 1)])
    series = np.array([(0.0, 1.0)], dtype=[("time", float), (f"ramp.{name}", float)])
    with pytest.raises(InputError, match=re.escape(REFUSED[name])):
        perilune.simulate(path, input=series)


def test_bounds_are_compared_before_the_flight_or_by_the_fmu_in_it(tiny_folder: Path, tmp_path: Path) -> None:
    path = packed(tmp_path, tiny_folder / "native")
    with pytest.raises(InputError, match=r"gain\.factor: 101 is above its maximum 100; give a smaller value"):
        fly(path, [perilune.Fault("gain.factor", "override", 101.0)])
    series = np.array([(0.0, 1.0), (1.0, -200.0)], dtype=[("time", float), ("gain.factor", float)])
    with pytest.raises(InputError, match=r"-200 is below its minimum -100; give a larger value"):
        perilune.simulate(path, input=series)
    flown = fly(path, [perilune.Fault("gain.factor", "bias", 98.0, 0.5)])
    assert flown.status == "failed"
    assert "factor = 101.0 is above its maximum 100.0" in flown.message
