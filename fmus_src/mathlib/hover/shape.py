"""Thrust angle and throttle of the simplified hover-to-hover programme over time. Kernel functions.

A lander turns from the vertical towards its target, over to the other side to brake, and back, with an angular
acceleration of +a, -a or 0. The engine gives full thrust once about the first turning point and once at the end, and
its least thrust in between. The deviation is the angle of thrust from the vertical, positive away from the target.

`HoverProgramme` contains the five times that determine the programme; `shape_of` computes its `HoverShape`.

Source: Huang 2017, with the cases in which segments of its equations join.
"""

import math

from ...kernel.records import Field, Record

STEEPEST = 0.5 * math.pi  # rad; largest deviation, beyond which thrust would push down


class HoverProgramme(Record):
    """Times (s) that determine a programme, named as in the paper; also used for differences of programmes."""

    t2 = Field(unit="s", description="time of the least thrust angle")
    t5 = Field(unit="s", description="time of the largest thrust angle")
    width = Field(
        unit="s",
        description="half duration w = t1 sqrt(2 (1 - k)) of a first burn symmetric about t2; 0: no first burn",
    )
    last_burn = Field(unit="s", description="duration tp of the last burn")
    t7 = Field(unit="s", description="end time of the programme")


class HoverShape(Record):
    """Times (s) at which angular acceleration and thrust switch, named t1 to t7 as in the paper."""

    t1 = Field(
        unit="s", frozen=True, description="time t1 of the first switching of the thrust axis' angular acceleration"
    )
    t2 = Field(unit="s", frozen=True, description="time t2 of the least thrust angle of the programme")
    t3 = Field(unit="s", frozen=True, description="time t3 at which the thrust axis starts to turn at a constant rate")
    t4 = Field(unit="s", frozen=True, description="time t4 at which the thrust axis stops turning at a constant rate")
    t5 = Field(unit="s", frozen=True, description="time t5 of the largest thrust angle of the programme")
    t6 = Field(
        unit="s", frozen=True, description="time t6 of the last switching of the thrust axis' angular acceleration"
    )
    t7 = Field(unit="s", frozen=True, description="end time t7 of the programme")
    first_burn_begin = Field(unit="s", frozen=True, description="start time of the programme's first burn")
    first_burn_end = Field(unit="s", frozen=True, description="end time of the programme's first burn")
    last_burn_begin = Field(
        unit="s", frozen=True, description="start time of the programme's last burn, which ends at t7"
    )
    d = Field(unit="s", frozen=True, description="duration t3 - t2")
    last = Field(unit="s", frozen=True, description="duration t7 - t6")


class PlannedShape(Record):
    """Shape of a programme, if one exists."""

    shape = Field(HoverShape, description="shape of the programme; all times 0 if the programme has none")
    exists = Field(bool, description="true: programme has a shape")


class PitchSegment(Record):
    """Parabola of the thrust angle over time."""

    begin = Field(unit="s", description="time from which the parabola counts")
    value = Field(unit="rad", description="thrust angle at that time")
    rate = Field(unit="rad/s", description="time derivative of the thrust angle at that time")
    half_acceleration = Field(unit="rad/s2", description="half of the thrust angle's second derivative")


class Pitch(Record):
    """Thrust angle and its rate."""

    deviation = Field(unit="rad", description="angle of thrust from the vertical, positive away from the target")
    rate = Field(unit="rad/s", description="time derivative of the thrust angle")


def without_programme() -> HoverProgramme:
    """Return an empty programme, with all times 0."""
    return HoverProgramme(t2=0.0, t5=0.0, width=0.0, last_burn=0.0, t7=0.0)


def without_shape() -> PlannedShape:
    """Return an empty shape, with all times 0."""
    shape = HoverShape(
        t1=0.0,
        t2=0.0,
        t3=0.0,
        t4=0.0,
        t5=0.0,
        t6=0.0,
        t7=0.0,
        first_burn_begin=0.0,
        first_burn_end=0.0,
        last_burn_begin=0.0,
        d=0.0,
        last=0.0,
    )
    return PlannedShape(shape=shape, exists=False)


def shape_of(p: HoverProgramme, acceleration: float) -> PlannedShape:
    """Return the shape of the programme p at an angular acceleration (rad/s2, > 0).

    t3 and t4 bound the interval of constant rate between the two turns; it begins d after t2 and ends d before t5, with
    d^2 - (t5 - t2) d + t1^2 + (t7 - t6)^2 = 0. No shape exists if this interval does not fit, if thrust would point
    down, or if the burns overlap.
    """
    first = 0.5 * p.t2
    last = 0.5 * (p.t7 - p.t5)
    between = p.t5 - p.t2
    width = p.width
    room = between * between - 4.0 * (first * first + last * last)
    turns = first >= 0.0 and last >= 0.0 and between > 0.0 and room >= 0.0 and acceleration > 0.0
    if not (turns and width >= 0.0 and p.last_burn >= 0.0 and math.isfinite(p.t7) and room < math.inf):
        return without_shape()
    if acceleration * first * first > STEEPEST or acceleration * last * last > STEEPEST:
        return without_shape()
    d = 2.0 * (first * first + last * last) / (between + math.sqrt(room))
    fraction = 2.0 * first * first - width * width  # 2 k t1^2
    if not fraction >= 0.0:
        return without_shape()
    begin = p.t2 - width
    if width > first:
        begin = math.sqrt(fraction)
    end = p.t2 + width
    if width > d:
        if not d > 0.0:
            return without_shape()
        end = p.t2 + (width * width + d * d) / (2.0 * d)
    s = HoverShape(
        t1=first,
        t2=p.t2,
        t3=p.t2 + d,
        t4=p.t5 - d,
        t5=p.t5,
        t6=p.t5 + last,
        t7=p.t7,
        first_burn_begin=begin,
        first_burn_end=end,
        last_burn_begin=p.t7 - p.last_burn,
        d=d,
        last=last,
    )
    return PlannedShape(shape=s, exists=s.first_burn_end <= s.last_burn_begin)


def pitch(s: HoverShape, acceleration: float, t: float) -> Pitch:
    """Return the thrust angle at time t (s); 0 before the start and after the end."""
    segment = pitch_segment(s, acceleration, t)
    since = t - segment.begin
    deviation = segment.value + since * (segment.rate + since * segment.half_acceleration)
    return Pitch(deviation=deviation, rate=segment.rate + 2.0 * since * segment.half_acceleration)


def pitch_segment(s: HoverShape, acceleration: float, t: float) -> PitchSegment:
    """Return the parabola of the thrust angle at time t (s)."""
    if not (t > 0.0 and t < s.t7):
        return parabola(t, 0.0, 0.0, 0.0)
    if t < s.t1:
        return parabola(0.0, 0.0, 0.0, -0.5 * acceleration)
    if t < s.t3:
        return parabola(s.t2, -acceleration * s.t1 * s.t1, 0.0, 0.5 * acceleration)
    if t < s.t4:
        return parabola(s.t3, acceleration * (0.5 * s.d * s.d - s.t1 * s.t1), acceleration * s.d, 0.0)
    if t < s.t6:
        return parabola(s.t5, acceleration * s.last * s.last, 0.0, -0.5 * acceleration)
    return parabola(s.t7, 0.0, 0.0, 0.5 * acceleration)


def parabola(begin: float, value: float, rate: float, half_acceleration: float) -> PitchSegment:
    """Return a segment with these fields."""
    return PitchSegment(begin=begin, value=value, rate=rate, half_acceleration=half_acceleration)


def full_thrust(s: HoverShape, t: float) -> bool:
    """Return True if the engine gives full thrust at time t (s), False if it gives its least thrust."""
    return (t >= s.first_burn_begin and t < s.first_burn_end) or (t >= s.last_burn_begin and t < s.t7)


def full_thrust_time(s: HoverShape, t: float) -> float:
    """Return the time (s) at full thrust between the start and t (s)."""
    time = 0.0
    if t > s.first_burn_begin:
        time = s.first_burn_end - s.first_burn_begin
        if t < s.first_burn_end:
            time = t - s.first_burn_begin
    if t > s.last_burn_begin:
        time = time + t - s.last_burn_begin
    return time
