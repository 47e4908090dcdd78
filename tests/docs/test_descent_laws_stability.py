"""The table of margins in docs/systems/descent_laws.md equals the result of the command above it.

Truth: the loops in closed form, with margins by python-control; both methods of the study. `make test` linearises one
law, `make long` studies all laws by both methods.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.stability.point.point_study import PointStudy
from perilune.analysis.stability.request.request import Subject, read_request
from perilune.common.paths import ROOT
from tests.support.lengths import LONG
from tests.support.loops.exact_lunar import HoverLoop
from tests.support.loops.exact_margins import crossings

PAGE = (ROOT / "docs" / "systems" / "descent_laws.md").read_text(encoding="utf-8")
ROW = re.compile(r"\| `(\w+)` \| ([xz]) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|")
TABLE = {(law, axis): tuple(map(float, numbers)) for law, axis, *numbers in ROW.findall(PAGE)}
TIME = 20.0  # s
AS_ZEM_ZEV = ["powered_guidance", "convex_guidance", "analytic_exact_guidance", "astar_robust_guidance"]
DECIBEL = 20.0 / np.log(10.0)
HALF_DIGIT = [0.5e-3, 0.5e-2, 0.5e-2, 0.5e-2]


def margins_of(loop):
    """Return crossover (rad/s), gain margin (dB), phase margin (deg), delay margin (s)."""
    margins = loop.classical
    gain, phase = DECIBEL * np.log(margins.gain_margin.value), np.degrees(margins.phase_margin.value)
    return margins.phase_margin.frequency, gain, phase, margins.delay_margin


def assert_agree(row, actual):
    for stated, value, half in zip(row, actual, HALF_DIGIT, strict=True):
        assert stated == pytest.approx(value, abs=1.02 * half)


def test_the_table_has_both_axes_of_three_laws():
    assert len(TABLE) == 6
    assert PAGE.count("--set guidance.frozen_time_to_go=20") == 1


@pytest.mark.parametrize(("law", "axis"), TABLE)
def test_rows_are_near_the_closed_form(law, axis):
    """Exact for ZEM/ZEV. The others hover away from the target with a thrust that changes along the profile."""
    gain, phase, frequency = crossings(HoverLoop(TIME, axis == "z", law != "zem_zev_guidance").state_space)
    crossover, gain_margin, phase_margin, delay_margin = TABLE[law, axis]
    near = {"zem_zev_guidance": (2e-3, 0.02), "fractional_guidance": (0.02, 0.15), "apollo_guidance": (0.08, 0.8)}
    relative, absolute = near[law]
    assert crossover == pytest.approx(frequency[0], rel=relative)
    assert gain_margin == pytest.approx(DECIBEL * np.log(np.min(gain[gain > 1.0])), abs=absolute)
    assert phase_margin == pytest.approx(np.degrees(phase[0]), abs=absolute)
    assert delay_margin == pytest.approx(phase[0] / frequency[0], rel=relative)


@pytest.mark.usefixtures("fmus")
def test_a_linearised_law_has_its_row():
    options = SystemOptions(use={"guidance": "fractional_guidance"}, set={"guidance.frozen_time_to_go": "20"})
    request = read_request("lunar_landing", options, at=(100.0,))
    (point,) = request.declaration.points  # the four declared ones differ in the time that is held only
    with PointStudy(Subject(request.system, request.options), point, request.loops_at(point)) as here:
        here.linearise()
        loop = here.loop_study(here.channels[2], request.declaration.limits).report(())
    assert loop.name == "acceleration.z"
    assert_agree(TABLE["fractional_guidance", "z"], margins_of(loop))


@pytest.mark.skipif(not LONG, reason="half a minute a law")
@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("law", [*dict.fromkeys(law for law, _ in TABLE), *AS_ZEM_ZEV])
def test_every_law_has_its_row_by_both_routes(law):
    report = perilune.stability(
        "lunar_landing", use={"guidance": law}, at=100.0, set={"guidance.frozen_time_to_go": TIME}
    )
    assert report.verdict == "pass"
    for loop in report.loops:
        assert loop.agreement.agrees
        assert DECIBEL * np.log(loop.agreement.gain) < 1e-3
        assert np.degrees(loop.agreement.phase) < 1e-3
        axis = loop.name[-1]
        if axis != "y":
            assert_agree(TABLE["zem_zev_guidance" if law in AS_ZEM_ZEV else law, axis], margins_of(loop))


@pytest.mark.usefixtures("fmus")
def test_a_gravity_turn_is_refused():
    with pytest.raises(perilune.InputError, match=r"gravity_turn_guidance.*frozen_time_to_go is 20, .*time_to_go is 0"):
        perilune.stability(
            "lunar_landing",
            use={"guidance": "gravity_turn_guidance"},
            at=100.0,
            set={"guidance.frozen_time_to_go": TIME},
        )
