"""Landing sequencer on the orbit: begin and end of the deorbit burn, and the coast.

Truth: the rules in docs/systems/landing_mission.md, with times and thresholds written out; the burn's duration from the
speeds on the ellipse.
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


def ellipse(pericentre, angle):
    """Estimate at a central angle on the ellipse from 100 km down to a pericentre altitude, 285 km before the site."""
    low, high = RADIUS + pericentre, ORBIT
    eccentricity, parameter = (high - low) / (high + low), 2.0 * high * low / (high + low)
    anomaly = 285e3 / RADIUS - angle
    radius = parameter / (1.0 + eccentricity * math.cos(anomaly))
    across = math.sqrt(MU / parameter) * (1.0 + eccentricity * math.cos(anomaly))
    along = math.sqrt(MU / parameter) * eccentricity * math.sin(anomaly)
    estimate = at(angle, altitude=radius - RADIUS, speed=across)
    x, y, z = estimate["estimated_velocity"]
    estimate["estimated_velocity"] = [x + along * math.sin(angle), y, z + along * math.cos(angle)]
    return estimate, radius - RADIUS


@pytest.mark.parametrize(("pericentre", "ends"), [(11e3, False), (400.0, False), (200.0, True), (-5e3, True)])
def test_a_low_coast_is_ended_only_where_it_comes_to_the_ground(pericentre, ends):
    """From 30 deg before the pericentre: 300 m are to be left over the ground, and the estimate says so for 20 s."""
    flown = Flown(2, **ellipse(pericentre, 285e3 / RADIUS + math.radians(30.0))[0])
    above = 0
    for n in range(400):
        estimate, altitude = ellipse(pericentre, 285e3 / RADIUS + math.radians(30.0 - 0.02 * n))
        flown.step(**estimate)
        above += altitude >= 12e3
        assert flown.block.phase == (3 if ends and n + 1 >= above + 200 else 2), (n, altitude)
    assert flown.block.status == (3 if ends else 0)


def test_first_fixes_may_say_that_the_coast_falls():
    """19 s of an estimate that leads to the ground, then one that does not: the coast continues."""
    low, high = (ellipse(pericentre, 285e3 / RADIUS + 0.3)[0] for pericentre in (-5e3, 8e3))
    flown = Flown(2, **low)
    assert flown.step(190).phase == 2
    assert flown.step(1, **high).phase == 2
    assert flown.step(190, **low).phase == 2
    assert flown.step(11).phase == 3
    assert flown.block.status == 3
