"""Time-optimal rotation about an axis between two rates with limited rate, acceleration and jerk. Kernel functions.

A profile begins and ends without acceleration: a ramp from the first rate to a peak rate, a coast, and a ramp to the
last rate, up to seven arcs of constant jerk. The peak rate is above both other rates if the angle is larger than the
angle of a direct ramp from the first rate to the last, and below both if it is smaller; a coast is at the rate limit.

Source: Biagiotti and Melchiorri 2008, section 3.4 (double S); proof: docs/systems/satellite_pointing.md.
"""

import math

from ..kernel.records import Field, Record

TURN = 2.0 * math.pi
HALVINGS = 200  # more halvings than the digits of a double need


class JerkLimits(Record):
    """Limits of rate, acceleration and jerk of a rotation."""

    rate = Field(unit="rad/s", description="largest angular rate, positive")
    acceleration = Field(unit="rad/s2", description="largest angular acceleration, positive")
    jerk = Field(unit="rad/s3", description="largest angular jerk, positive")


class AxisMotion(Record):
    """Angle, rate and acceleration about an axis."""

    angle = Field(unit="rad", description="rotation angle since the start")
    rate = Field(unit="rad/s", description="angular rate")
    acceleration = Field(unit="rad/s2", description="angular acceleration")


class RateProfile(Record):
    """Profile of the angular rate: two ramps with a coast between them."""

    angle = Field(unit="rad", description="angle covered by the whole profile")
    first_rate = Field(unit="rad/s", description="angular rate at the start of the profile")
    peak_rate = Field(unit="rad/s", description="angular rate of the coast")
    last_rate = Field(unit="rad/s", description="angular rate at the end of the profile")
    duration = Field(unit="s", description="duration of the whole profile")
    acceleration = Field(unit="rad/s2", description="largest angular acceleration of the profile")
    jerk = Field(unit="rad/s3", description="largest angular jerk of the profile")


def ramp_time(change: float, acceleration: float, jerk: float) -> float:
    """Return the least time (s) for a change of rate (rad/s) that begins and ends without acceleration."""
    size = abs(change)
    if size * jerk >= acceleration * acceleration:
        return size / acceleration + acceleration / jerk
    return 2.0 * math.sqrt(size / jerk)


def ramp_angle(first: float, last: float, acceleration: float, jerk: float) -> float:
    """Return the angle (rad) of the symmetric ramp between two rates (rad/s)."""
    return 0.5 * (first + last) * ramp_time(last - first, acceleration, jerk)


def follow_ramp(first: float, last: float, acceleration: float, jerk: float, time: float) -> AxisMotion:
    """Return the motion at a time (s) within the ramp between two rates (rad/s)."""
    size = abs(last - first)
    duration = ramp_time(size, acceleration, jerk)
    peak = math.sqrt(size * jerk)
    if peak > acceleration:
        peak = acceleration
    sense = math.copysign(1.0, last - first)
    bend = peak / jerk
    to_go = duration - time
    if to_go < bend:
        return AxisMotion(
            angle=0.5 * (first + last) * duration - last * to_go + sense * jerk * to_go * to_go * to_go / 6.0,
            rate=last - sense * 0.5 * jerk * to_go * to_go,
            acceleration=sense * jerk * to_go,
        )
    if time < bend:
        return AxisMotion(
            angle=first * time + sense * jerk * time * time * time / 6.0,
            rate=first + sense * 0.5 * jerk * time * time,
            acceleration=sense * jerk * time,
        )
    return AxisMotion(
        angle=first * time + sense * peak * (0.5 * time * (time - bend) + bend * bend / 6.0),
        rate=first + sense * peak * (time - 0.5 * bend),
        acceleration=sense * peak,
    )


def both_ramps(first: float, peak: float, last: float, acceleration: float, jerk: float) -> float:
    """Return the angle (rad) of the ramps to and from a peak rate (rad/s) without a coast."""
    return ramp_angle(first, peak, acceleration, jerk) + ramp_angle(peak, last, acceleration, jerk)


def reach_peak(angle: float, first: float, last: float, limits: JerkLimits) -> float:
    """Return the peak rate (rad/s), above both other rates, at which ramps without a coast cover an angle (rad).

    The angle must lie between the angle of the direct ramp from first to last rate and the angle of the ramps with the
    peak at the limit. As a function of the peak, the angle of the ramps starts at the first of these and either grows,
    or falls and then grows, so there is one root.
    """
    low = first
    if last > low:
        low = last
    high = limits.rate
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            return low
        if both_ramps(first, middle, last, limits.acceleration, limits.jerk) <= angle:
            low = middle
        else:
            high = middle
    return low


def plan_ramp(first: float, last: float, limits: JerkLimits) -> RateProfile:
    """Return the profile of least time for a change between two rates (rad/s) over any angle."""
    return RateProfile(
        angle=ramp_angle(first, last, limits.acceleration, limits.jerk),
        first_rate=first,
        peak_rate=last,
        last_rate=last,
        duration=ramp_time(last - first, limits.acceleration, limits.jerk),
        acceleration=limits.acceleration,
        jerk=limits.jerk,
    )


def plan_axis(angle: float, first: float, last: float, limits: JerkLimits) -> RateProfile:
    """Return the profile of least time for an angle (rad) between two rates (rad/s) within the rate limit."""
    direct = plan_ramp(first, last, limits)
    if angle == direct.angle:
        return direct
    sense = 1.0
    if angle < direct.angle:
        sense = -1.0
    a = sense * first
    b = sense * last
    peak = limits.rate
    coast = (sense * angle - both_ramps(a, peak, b, limits.acceleration, limits.jerk)) / peak
    if coast < 0.0:
        coast = 0.0
        peak = reach_peak(sense * angle, a, b, limits)
    ramps = ramp_time(peak - a, limits.acceleration, limits.jerk) + ramp_time(
        peak - b, limits.acceleration, limits.jerk
    )
    return RateProfile(
        angle=angle,
        first_rate=first,
        peak_rate=sense * peak,
        last_rate=last,
        duration=ramps + coast,
        acceleration=limits.acceleration,
        jerk=limits.jerk,
    )


def plan_turn(angle: float, first: float, last: float, limits: JerkLimits) -> RateProfile:
    """Return the profile of least time for an angle (rad) modulo whole revolutions.

    The time grows with the distance of the angle from the angle of the direct ramp between the two rates, so only the
    two angles next to it are compared.
    """
    direct = ramp_angle(first, last, limits.acceleration, limits.jerk)
    turns = (direct - angle) / TURN
    whole = turns - math.fmod(turns, 1.0)
    if whole > turns:
        whole = whole - 1.0
    below = angle + whole * TURN
    upper = plan_axis(below + TURN, first, last, limits)
    lower = plan_axis(below, first, last, limits)
    if lower.duration < upper.duration:
        return lower
    return upper


def follow_profile(profile: RateProfile, time: float) -> AxisMotion:
    """Return the motion at a time (s) between 0 and the profile's duration."""
    begin = ramp_time(profile.peak_rate - profile.first_rate, profile.acceleration, profile.jerk)
    end = ramp_time(profile.peak_rate - profile.last_rate, profile.acceleration, profile.jerk)
    to_go = profile.duration - time
    if time < begin:
        return follow_ramp(profile.first_rate, profile.peak_rate, profile.acceleration, profile.jerk, time)
    if to_go < end:
        back = follow_ramp(profile.last_rate, profile.peak_rate, profile.acceleration, profile.jerk, to_go)
        return AxisMotion(angle=profile.angle - back.angle, rate=back.rate, acceleration=-back.acceleration)
    return AxisMotion(
        angle=0.5 * (profile.first_rate + profile.peak_rate) * begin + profile.peak_rate * (time - begin),
        rate=profile.peak_rate,
        acceleration=0.0,
    )
