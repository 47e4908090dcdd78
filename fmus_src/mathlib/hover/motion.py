"""Motion under the simplified hover-to-hover programme, by quadrature. Kernel functions.

The controls depend on time alone, so velocity and position are integrals: x'' = A cos th, y'' = A sin th - g, with A
the full or least thrust over the remaining mass. The plane of the transfer has x towards the target and y up; the
motion starts at rest.

Source: Huang 2017; Gauss-Legendre quadrature: Abramowitz and Stegun 1964, table 25.4.
"""

from ...kernel.functions import cos, log, sin
from ...kernel.records import Field, Record
from .shape import HoverProgramme, HoverShape, full_thrust, full_thrust_time, pitch_segment, shape_of

LONGEST = 30.0  # s; longest interval of eight nodes, for errors below 1e-9 of the motion


class HoverVehicle(Record):
    """Properties of a lander for the planning of a programme."""

    full = Field(unit="m/s2", frozen=True, description="largest thrust in the plan over the mass at its start")
    least = Field(unit="m/s2", frozen=True, description="least thrust in the plan over the mass at its start")
    exhaust = Field(unit="m/s", frozen=True, description="exhaust speed of the engine")
    gravity = Field(unit="m/s2", frozen=True, description="uniform gravitational acceleration assumed by the plan")
    swing = Field(unit="rad/s2", frozen=True, description="angular acceleration of the thrust axis in the plan")


class PlaneMotion(Record):
    """Motion in the plane of a transfer."""

    x = Field(unit="m", description="horizontal distance from the start, towards the target")
    x_rate = Field(unit="m/s", description="horizontal velocity towards the target")
    y = Field(unit="m", description="height above the start")
    y_rate = Field(unit="m/s", description="upward velocity")
    exists = Field(bool, description="true: mass is left and the programme has a shape")


class ThrustSpan(Record):
    """Time span with a parabolic thrust angle and constant thrust."""

    end = Field(unit="s", description="end of the span")
    thrust = Field(unit="m/s2", description="thrust over the mass at the start of the programme")


def without_motion() -> PlaneMotion:
    """Return the motion at rest at the starting point, marked as nonexistent."""
    return PlaneMotion(x=0.0, x_rate=0.0, y=0.0, y_rate=0.0, exists=False)


def propellant(s: HoverShape, vehicle: HoverVehicle, t: float) -> float:
    """Return the propellant used until t (s, at most the end of the shape s), divided by the initial mass."""
    return (vehicle.least * t + (vehicle.full - vehicle.least) * full_thrust_time(s, t)) / vehicle.exhaust


def thrust_impulse(s: HoverShape, vehicle: HoverVehicle, begin: float, end: float) -> float:
    """Return the integral (m/s) of thrust over mass between two times (s); 0 if no mass is left."""
    before = 1.0 - propellant(s, vehicle, begin)
    after = 1.0 - propellant(s, vehicle, end)
    if not (before > 0.0 and after > 0.0):
        return 0.0
    return vehicle.exhaust * log(before / after)


def motion(s: HoverShape, vehicle: HoverVehicle, until: float) -> PlaneMotion:
    """Return the motion at time ``until`` (s)."""
    x = 0.0
    vx = 0.0
    y = 0.0
    vy = 0.0
    node = [0.0] * 8
    weight = [0.0] * 8
    nodes(node, weight)
    begin = 0.0
    mass = 1.0
    for _ in range(9):
        if begin < until:
            ahead = thrust_span(s, vehicle, begin, until)
            segment = pitch_segment(s, vehicle.swing, 0.5 * (begin + ahead.end))
            span = ahead.end - begin
            flow = ahead.thrust / vehicle.exhaust
            if not (mass - flow * span > 0.0 and span < 1e4):
                return without_motion()
            parts = int(span / LONGEST) + 1
            span = span / float(parts)
            scale = span * ahead.thrust
            for _ in range(parts):
                since_begin = begin - segment.begin
                left = until - begin
                for k in range(8):
                    part = span * node[k]
                    since = since_begin + part
                    deviation = segment.value + since * (segment.rate + since * segment.half_acceleration)
                    push = scale * weight[k] / (mass - flow * part)
                    side = push * sin(deviation)
                    lift = push * cos(deviation)
                    vx = vx - side
                    x = x - (left - part) * side
                    vy = vy + lift
                    y = y + (left - part) * lift
                begin = begin + span
                mass = mass - flow * span
            begin = ahead.end
    drop = 0.5 * vehicle.gravity * until * until
    return PlaneMotion(x=x, x_rate=vx, y=y - drop, y_rate=vy - vehicle.gravity * until, exists=True)


def end_motion(p: HoverProgramme, vehicle: HoverVehicle) -> PlaneMotion:
    """Return the motion at the end of a programme."""
    planned = shape_of(p, vehicle.swing)
    if not planned.exists:
        return without_motion()
    return motion(planned.shape, vehicle, p.t7)


def thrust_span(s: HoverShape, vehicle: HoverVehicle, begin: float, until: float) -> ThrustSpan:
    """Return the span that starts at ``begin`` (s) and ends at the next switching time or at ``until`` (s)."""
    end = until
    thrust = vehicle.least
    if full_thrust(s, begin):
        thrust = vehicle.full
    end = earlier_end(s.t1, begin, end)
    end = earlier_end(s.t3, begin, end)
    end = earlier_end(s.t4, begin, end)
    end = earlier_end(s.t6, begin, end)
    end = earlier_end(s.t7, begin, end)
    end = earlier_end(s.first_burn_begin, begin, end)
    end = earlier_end(s.first_burn_end, begin, end)
    end = earlier_end(s.last_burn_begin, begin, end)
    return ThrustSpan(end=end, thrust=thrust)


def earlier_end(time: float, begin: float, end: float) -> float:
    """Return the time (s) if it lies between begin and end, otherwise the end."""
    if time > begin and time < end:
        return time
    return end


def nodes(node: list, weight: list) -> None:
    """Set abscissas and weights of the eight-point Gauss-Legendre quadrature over [0, 1]."""
    place = [0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363]
    fraction = [0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763]
    for k in range(4):
        node[k] = 0.5 - 0.5 * place[k]
        node[7 - k] = 0.5 + 0.5 * place[k]
        weight[k] = 0.5 * fraction[k]
        weight[7 - k] = 0.5 * fraction[k]
