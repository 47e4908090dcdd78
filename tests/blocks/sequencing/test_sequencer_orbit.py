"""The landing sequencer on its orbit: when the deorbit burn begins and ends, and the coast.

Truth: the rules as docs/systems/landing_mission.md has them, with times and thresholds written out; the burn's length
from the ellipse's own speeds.
"""

import math

import pytest

from tests.support.flights.sequenced import MU, ORBIT, RADIUS, SPEED, Flown, H, at


def test_the_deorbit_is_timed_so_that_braking_begins_at_its_range():
    """On the circle: waits, ignites half a burn early, and commands until the ellipse is reached."""
    rate = SPEED / ORBIT
    flown = Flown(1, mass=946.0)
    first = math.pi + 285e3 / RADIUS + 60.0 * rate
    slow = math.sqrt(2.0 * MU * (RADIUS + 15e3) / (ORBIT * (ORBIT + RADIUS + 15e3)))
    burn = (SPEED - slow) / (0.1 * 5099.0 / 946.0)
    for n in range(2000):
        block = flown.step(**at(first - rate * flown.time))
        if block.engine_on:
            break
        assert block.thrust_acceleration == 0.0
        # against the velocity, and turning with it, at the time of the estimate
        angle = first - rate * n * H
        assert block.command_time == pytest.approx(n * H)
        assert block.thrust_direction == pytest.approx([math.cos(angle), 0.0, -math.sin(angle)], abs=1e-9)
        assert block.thrust_direction_rate == pytest.approx(
            [rate * math.sin(angle), 0.0, rate * math.cos(angle)], abs=1e-9
        )
    assert flown.time == pytest.approx(60.0 - burn / 2.0, abs=0.2)
    assert burn == pytest.approx(36.1, abs=0.1)
    assert block.thrust_acceleration == pytest.approx(509.9 / 946.0)
    assert block.burn_duration == pytest.approx(burn + H, abs=1e-6)  # from ignition, a step after the estimate
    ignition = flown.time
    while block.engine_on:
        speed = SPEED - 509.9 / 946.0 * (flown.time - ignition)
        held = block.command_time + block.burn_duration - flown.time
        end = block.command_time + block.burn_duration
        flown.step(**at(first - rate * flown.time, speed=speed))
        if block.engine_on:
            moved = block.command_time + block.burn_duration - end
            assert abs(moved) < 1e-6
            assert block.command_time == pytest.approx(flown.time - H if held > 1.0 + H else block.command_time)
    assert flown.time == pytest.approx(ignition + burn, abs=H)
    assert block.phase == 2
    assert block.status == 0


def test_a_deorbit_that_does_not_slow_down_is_ended():
    flown = Flown(1, **at(math.pi))
    flown.see(mass=946.0)
    ignition = flown.step().phase_time[0] + H
    end = flown.until(2, 100.0)
    slow = math.sqrt(2.0 * MU * (RADIUS + 15e3) / (ORBIT * (ORBIT + RADIUS + 15e3)))
    planned = (SPEED - slow) / (0.1 * 5099.0 / 946.0)
    assert end - ignition == pytest.approx(2.0 * planned, abs=1.5 * H)
    assert flown.block.status == 3
    assert flown.block.status_time[2] == end


def test_who_is_slow_enough_goes_on_to_the_coast_at_once():
    flown = Flown(1, **at(math.pi, speed=1600.0))
    assert flown.until(2, 1.0) <= 2 * H
    assert flown.block.status == 0


@pytest.mark.parametrize(("angle", "comes"), [(math.pi, False), (0.2, False), (284e3 / RADIUS, True)])
def test_the_coast_ends_at_the_range(angle, comes):
    flown = Flown(2, **at(angle, altitude=15e3, speed=1690.0))
    block = flown.step()
    assert block.phase == (3 if comes else 2)
    assert block.status == 0
    assert not block.engine_on


def test_a_coast_that_comes_too_low_is_ended():
    flown = Flown(2, **at(1.0, altitude=12.1e3))
    assert flown.step().phase == 2
    assert flown.step(**at(1.0, altitude=11.9e3)).phase == 3
    assert flown.block.status == 3
