"""`perilune.fmus_src.mathlib.hover.programme` and its modules: the simplified hover-to-hover programme.

Truth: scipy's DOP853 on the paper's full equations (Huang 2017), with pitch as a state driven by the switched angular
acceleration, and the first burn as in the paper, below a share of the largest deviation; for a vertical descent, the
closed form of the rocket equation, solved by scipy; numbers printed in the paper, and numbers from two independent
programs.
"""

import math
import random

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import fsolve

from perilune.fmus_src.kernel.records import replace
from perilune.fmus_src.mathlib.hover.motion import HoverVehicle, end_motion, motion, propellant, thrust_impulse
from perilune.fmus_src.mathlib.hover.programme import programme, programme_of_duration
from perilune.fmus_src.mathlib.hover.shape import HoverProgramme, full_thrust, pitch, shape_of, without_programme
from perilune.fmus_src.mathlib.hover.solution import PlanKind, propellant_fraction
from tests.support.flights.hover_equations import flown, share_of
from tests.support.lengths import either

EARTH = 9.80665
DROP = -2300.0
PAPER = HoverVehicle.of_elements([0.8 * EARTH, 0.8 * EARTH / 15.0, 300.0 * EARTH, 1.622, math.radians(1.0)])
MARGINS = HoverVehicle.of_elements([0.9 * 0.8 * EARTH, 0.1 * 0.8 * EARTH, 300.0 * EARTH, 1.622, math.radians(0.7)])


def planned(x, y=DROP, vehicle=PAPER, duration=None):
    """Return kind, programme, propellant fraction."""
    plan = programme(x, y, vehicle) if duration is None else programme_of_duration(x, y, duration, vehicle)
    return plan.kind, plan.programme, propellant_fraction(plan.programme, vehicle) if plan.kind else None


def test_published_case_without_minimising():
    kind, p, mu = planned(1600.0, duration=78.0)
    assert kind == PlanKind.WITH_FIRST_BURN
    assert [p.t2, p.t5, p.last_burn] == pytest.approx([15.0086, 64.7012, 10.9309], abs=0.02)
    assert p.width == pytest.approx(1.6991, abs=0.001)
    assert share_of(p.elements()) == pytest.approx(0.9744, abs=0.001)
    assert mu == pytest.approx(0.04953, abs=2e-5)
    # the paper's own, its t5 mended
    assert [p.t2, p.t5, p.last_burn] == pytest.approx([15.0444, 64.7528, 10.9621], abs=0.06)
    assert share_of(p.elements()) == pytest.approx(0.9748, abs=0.001)
    assert mu == pytest.approx(0.0494, abs=2e-4)


def test_best_duration():
    kind, p, mu = planned(1600.0)
    assert kind == PlanKind.WITH_FIRST_BURN
    assert p.elements() == pytest.approx([15.2696, 63.6422, 1.6968, 10.9894, 77.157], abs=0.01)
    assert mu == pytest.approx(0.049514, abs=5e-6)
    for other in (-1.0, -0.1, 0.1, 1.0):
        assert planned(1600.0, duration=p.t7 + other)[2] > mu


LIGHT = HoverVehicle.of_elements([2.43, 0.27, 2942.0, 1.62, 0.2])
WEAK = HoverVehicle.of_elements([2.57259, 0.28468, 3526.84, 1.622, 0.032691])


@pytest.mark.parametrize(
    ("x", "y", "vehicle", "ends"),
    [
        (39.0, -58.0, LIGHT, (16.5, 16.6, 16.8, 17.0)),
        (40.0, -58.0, LIGHT, (16.5, 16.6, 16.8, 17.0)),
        (42.0, -58.0, LIGHT, (16.6, 16.8, 17.0)),
        (1713.8, -2065.1, WEAK, (92.6, 92.8, 93.5, 94.5)),  # where the end turns back as the first burn gets longer
    ],
)
def test_no_plan_of_another_duration_is_cheaper_where_the_first_burn_begins_abruptly(x, y, vehicle, ends):
    kind, _, mu = planned(x, y, vehicle)
    assert kind == PlanKind.WITH_FIRST_BURN
    others = [planned(x, y, vehicle, end) for end in ends]
    assert PlanKind.WITH_FIRST_BURN in [other[0] for other in others]
    assert mu < min(other[2] for other in others if other[0] != PlanKind.NONE)


@pytest.mark.parametrize("x", either([44.0, 45.0, 50.0, 60.0], [45.0]))
def test_a_first_burn_that_begins_abruptly_leads_further(x):
    """Beyond the farthest place without first burn, near which none begins."""
    kind, p, mu = planned(x, -58.0, LIGHT)
    assert kind == PlanKind.WITH_FIRST_BURN
    end = flown(p.elements(), LIGHT.elements())
    assert end[:4] == pytest.approx([x, 0.0, -58.0, 0.0], abs=1e-6)
    assert end[4] == pytest.approx(mu, abs=1e-9)
    assert planned(42.0, -58.0, LIGHT)[2] < mu < planned(42.0, -58.0, LIGHT)[2] * x / 42.0


def test_search_takes_a_dearer_programme_just_before_the_farthest_without_first_burn():
    """The limit that docs/concepts/limits.md states: propellant is nearly linear in the distance around 43 m."""
    kind, _, mu = planned(43.0, -58.0, LIGHT)
    assert kind == PlanKind.WITHOUT_FIRST_BURN
    between = 0.5 * (planned(42.0, -58.0, LIGHT)[2] + planned(44.0, -58.0, LIGHT)[2])
    assert 1.0 - between / mu == pytest.approx(0.019, abs=5e-4)


def test_published_pitch():
    _, p, _ = planned(1600.0)
    planned_shape = shape_of(p, PAPER.swing)
    assert planned_shape.exists
    s = planned_shape.shape
    angles = [90.0 + math.degrees(pitch(s, PAPER.swing, t).deviation) for t in np.linspace(0.0, p.t7, 4001)]
    assert min(angles) == pytest.approx(31.7, abs=0.05)
    assert max(angles) == pytest.approx(135.7, abs=0.05)
    assert math.degrees(pitch(s, PAPER.swing, 40.0).rate) == pytest.approx(2.254, abs=5e-4)


def test_control_margins():
    kind, p, mu = planned(1600.0, vehicle=MARGINS)
    assert kind == PlanKind.WITH_FIRST_BURN
    assert p.elements() == pytest.approx([18.430, 64.428, 1.5178, 11.309, 82.186], abs=0.005)
    assert mu == pytest.approx(0.052518, abs=1e-6)


@pytest.mark.parametrize(
    ("duration", "fraction"), [(70.0, 0.05093), (74.0, 0.04976), (78.0, 0.04953), (84.0, 0.05038), (90.0, 0.05210)]
)
def test_propellant_over_duration(duration, fraction):
    kind, p, mu = planned(1600.0, duration=duration)
    assert (kind, p.t7) == (PlanKind.WITH_FIRST_BURN, duration)
    assert mu == pytest.approx(fraction, abs=6e-6)


@pytest.mark.parametrize(
    ("x", "fraction", "kind"),
    [
        (0.0, 0.037878, PlanKind.VERTICAL),
        (200.0, 0.037927, PlanKind.WITHOUT_FIRST_BURN),
        (500.0, 0.038544, PlanKind.WITHOUT_FIRST_BURN),
        (600.0, 0.03946, PlanKind.WITH_FIRST_BURN),
        (800.0, 0.04143, PlanKind.WITH_FIRST_BURN),
        (1000.0, 0.04344, PlanKind.WITH_FIRST_BURN),
        (2500.0, 0.05801, PlanKind.WITH_FIRST_BURN),
    ],
)
def test_propellant_over_distance(x, fraction, kind):
    actual, _, mu = planned(x)
    assert actual == kind
    assert mu == pytest.approx(fraction, abs=6e-6)


def test_sideways_costs_what_the_paper_says_and_grows_linearly():
    vertical = planned(0.0)[2]
    assert vertical == pytest.approx(0.03788, abs=5e-6)
    ratio = planned(1600.0)[2] / vertical
    assert ratio == pytest.approx(1.307, abs=0.002)
    assert ratio == pytest.approx(1.29, abs=0.02)  # the paper's 29 %
    distances = np.linspace(700.0, 1600.0, either(31, 5))
    fractions = [planned(x)[2] for x in distances]
    line = np.polyfit(distances, fractions, 1)
    assert np.max(np.abs(np.polyval(line, distances) - fractions)) < 2.5e-5
    assert line == pytest.approx([1.0102e-5, 0.033349], rel=2e-3)


def end_of(p, vehicle=PAPER):
    end = end_motion(p, vehicle)
    assert end.exists
    return [end.x, end.x_rate, end.y, end.y_rate]


def test_wrong_digit_of_the_paper():
    width = 0.5 * 15.0444 * math.sqrt(2.0 * (1.0 - 0.9748))
    corrected = HoverProgramme(t2=15.0444, t5=64.7528, width=width, last_burn=10.9621, t7=78.0)
    printed = end_of(replace(corrected, t5=63.7528))
    mended = end_of(corrected)
    assert abs(printed[0] - 1600.0) == pytest.approx(64.0, abs=1.0)
    assert abs(printed[2] - DROP) == pytest.approx(26.0, abs=1.0)
    assert abs(printed[1]) == pytest.approx(2.8, abs=0.05)
    assert DROP - mended[2] == pytest.approx(11.9, abs=0.1)
    assert propellant_fraction(corrected, PAPER) == pytest.approx(0.04956, abs=5e-6)


@pytest.mark.parametrize(
    ("x", "vehicle", "duration"),
    [(1600.0, PAPER, 78.0), (1600.0, MARGINS, None), (400.0, PAPER, None), (0.0, PAPER, None)],
)
def test_full_equations_end_where_they_should(x, vehicle, duration):
    _, p, mu = planned(x, vehicle=vehicle, duration=duration)
    end = flown(p.elements(), vehicle.elements())
    assert end[:4] == pytest.approx([x, 0.0, DROP, 0.0], abs=1e-6)
    assert end[4] == pytest.approx(mu, abs=1e-9)
    assert end[5:] == pytest.approx([0.5 * math.pi, 0.0], abs=1e-9)


def test_low_drops_with_far_sides_stay_above_the_target():
    for x, y in ((600.0, -300.0), (1600.0, -500.0), (50.0, -100.0)):
        kind, p, _ = planned(x, y)
        assert kind == PlanKind.WITH_FIRST_BURN
        assert flown(p.elements(), PAPER.elements())[:4] == pytest.approx([x, 0.0, y, 0.0], abs=1e-6)
        planned_shape = shape_of(p, PAPER.swing)
        assert planned_shape.exists
        s = planned_shape.shape
        for t in np.linspace(0.0, p.t7, 101):
            state = motion(s, PAPER, t)
            assert state.exists
            assert state.y > y - 1e-6


@pytest.mark.parametrize("t", [5.0, 15.0, 20.0, 62.0, 70.0, 77.0])
def test_motion_pitch_and_propellant_on_the_way(t):
    _, p, _ = planned(1600.0)
    planned_shape = shape_of(p, PAPER.swing)
    assert planned_shape.exists
    s = planned_shape.shape
    state = motion(s, PAPER, t)
    assert state.exists
    turn = pitch(s, PAPER.swing, t)
    actual = [
        state.x,
        state.x_rate,
        state.y,
        state.y_rate,
        propellant(s, PAPER, t),
        0.5 * math.pi + turn.deviation,
        turn.rate,
    ]
    assert actual == pytest.approx(flown(p.elements(), PAPER.elements(), until=t), abs=1e-7)


def test_impulse_is_the_integral_of_thrust_over_mass():
    _, p, _ = planned(1600.0)
    planned_shape = shape_of(p, PAPER.swing)
    assert planned_shape.exists
    s = planned_shape.shape

    def push(t):
        return (PAPER.full if full_thrust(s, t) else PAPER.least) / (1.0 - propellant(s, PAPER, t))

    switches = (s.first_burn_begin, s.first_burn_end, s.last_burn_begin)
    for begin, end in ((0.0, 10.0), (13.0, 14.0), (14.0, 18.0), (60.0, 70.0), (10.0, p.t7)):
        truth = quad(
            push,
            begin,
            end,
            points=[t for t in switches if begin < t < end],
            epsabs=1e-12,
        )[0]
        assert thrust_impulse(s, PAPER, begin, end) == pytest.approx(truth, abs=1e-9)


def test_straight_down_is_the_rocket_equation():
    full, minimum, c, gravity, _ = PAPER.elements()
    q, r = minimum / c, full / c

    def missing(times):
        coast, burn = times
        # velocity and way of a constant mass flow, from the integral of -c log(m)
        left = 1.0 - q * coast
        speed = -c * math.log(left) - gravity * coast
        way = c * (coast + left / q * math.log(left)) - 0.5 * gravity * coast**2
        end = left - r * burn
        speed_end = speed + c * math.log(left / end) - gravity * burn
        way_end = way + speed * burn + c * (burn + end / r * math.log(end / left)) - 0.5 * gravity * burn**2
        return [way_end - DROP, speed_end]

    coast, burn = fsolve(missing, [60.0, 10.0], xtol=1e-13)
    kind, p, mu = planned(0.3)  # so near that it is flown straight down
    assert kind == PlanKind.VERTICAL
    assert p.elements() == pytest.approx([0.0, coast + burn, 0.0, burn, coast + burn], abs=1e-7)
    assert mu == pytest.approx(q * coast + r * burn, abs=1e-10)


def test_random_vehicles_and_targets():
    draws = random.Random(14)
    for _ in range(either(600, 12)):
        y = -draws.uniform(2000.0, 2600.0)
        x = draws.uniform(0.0, 1.3) * -y
        thrust, limit = EARTH * draws.uniform(0.7, 1.05), draws.uniform(0.85, 1.0)
        swing = math.radians(draws.uniform(0.6, 1.0))
        least = draws.uniform(1.0 / 15.0, 0.1) * thrust
        vehicle = HoverVehicle.of_elements([limit * thrust, least, 300.0 * EARTH, 1.622, swing])
        kind, p, mu = planned(x, y, vehicle)
        assert kind != PlanKind.NONE, (x, y, vehicle)
        assert 0.0 < mu < 1.0
        assert end_of(p, vehicle) == pytest.approx([x if x >= 1.0 else 0.0, 0.0, y, 0.0], abs=1e-7)
        assert kind != PlanKind.WITH_FIRST_BURN or 0.0 < p.width <= p.t2 / math.sqrt(2.0)


@pytest.mark.parametrize(
    ("x", "y", "change"),
    [
        (1600.0, 0.0, {}),
        (1600.0, 100.0, {}),
        (math.nan, DROP, {}),
        (1600.0, -math.inf, {}),
        (1600.0, DROP, {"full": 1.5}),
        (1600.0, DROP, {"least": 1.7}),
        (1600.0, DROP, {"swing": 0.0}),
        (1600.0, DROP, {"exhaust": math.nan}),
        (1600.0, DROP, {"exhaust": 10.0}),
        (1e300, DROP, {}),
        (20.0, -20.0, {}),
    ],
)
def test_no_programme(x, y, change):
    vehicle = replace(PAPER, **change)
    assert planned(x, y, vehicle)[:2] == (PlanKind.NONE, without_programme())


def test_no_programme_of_that_duration():
    assert planned(0.0, duration=80.0)[0] == PlanKind.NONE
    assert planned(1600.0, duration=40.0)[0] == PlanKind.NONE
    assert planned(1600.0, duration=math.inf)[0] == PlanKind.NONE


@pytest.mark.parametrize(("x", "y"), [(3172.0, -898.0), (5544.0, -951.0), (4600.0, -2350.0), (6650.0, -480.0)])
def test_far_sides_never_thrust_downwards(x, y):
    vehicle = MARGINS
    kind, p, _ = planned(x, y, vehicle)
    if kind == PlanKind.WITH_FIRST_BURN:
        angles = [flown(p.elements(), vehicle.elements(), until=t)[5] for t in np.linspace(0.1, 0.999, 25) * p.t7]
        assert min(angles) >= -1e-9
        assert max(angles) <= math.pi + 1e-9
    assert kind in (PlanKind.WITH_FIRST_BURN, PlanKind.NONE)


def test_longer_than_the_one_without_first_burn():
    kind, p, mu = planned(400.0, duration=70.0)
    assert kind == PlanKind.WITH_FIRST_BURN
    assert p.t7 == 70.0
    assert mu > planned(400.0)[2]
    assert end_of(p) == pytest.approx([400.0, 0.0, DROP, 0.0], abs=1e-7)
