"""Powered explicit guidance with one phase of constant thrust for position and velocity targets. Kernel functions.

The thrust is parallel to lambda + lambda' (t - K), with lambda perpendicular to lambda' and t measured from the
present; the time to go T and the thrust F are unknowns as well. With tau = v_e m/F the integrals of the thrust
acceleration and its moments are

    L = v_e ln(tau/(tau - T)),  J = tau L - v_e T,  S = L T - J,  Q = S tau - v_e T^2/2,  P = Q tau - v_e T^3/6,
    H = J T - Q,  K = J/L.

Source: Jaggers 1977, "An explicit solution to the exoatmospheric powered flight guidance and trajectory optimization
problem for rocket propelled vehicles"; McHenry et al. 1979. The thrust as the sixth unknown, for descent, was added in
this repository.
"""

from ...kernel.functions import exp, expm1, log
from ...kernel.records import Field, Record, replace
from ..vectors import Vector3, clip, dot, norm

MOST_BURNT = 0.999  # largest time to go, as a fraction of tau
SETTLED = 1e-6  # relative change of the time to go
SHORTEST = 1e-3  # s, least time to go
LARGEST_IMPULSE = 20.0  # in units of the exhaust speed
SMALLEST_SPREAD = 1e-9  # least magnitude of Q - S K, as a fraction of S T
LOWEST_OF_MINIMUM = 0.5  # least thrust in an iteration, as a fraction of the minimum thrust
MOST_OF_MAXIMUM = 1.3  # largest thrust in an iteration, as a fraction of the maximum thrust


class SteeringState(Record):
    """Unknowns of the guidance after an iteration."""

    time = Field(unit="s", description="time to go of the linear-tangent steering")
    thrust = Field(unit="N", description="constant thrust of the linear-tangent steering")
    direction = Field(
        Vector3, unit="1", frame="landing site", description="thrust direction vector lambda at the time K"
    )
    turning = Field(
        Vector3, unit="1/s", frame="landing site", description="time derivative of the thrust direction vector lambda"
    )
    centre = Field(unit="s", description="time K from now at which lambda is the thrust direction")
    change = Field(
        unit="1", description="relative change of the time to go in the last iteration; below 0: no solution"
    )


class SteeringProblem(Record):
    """Required changes of position and velocity, and engine data, for an iteration."""

    way = Field(Vector3, unit="m", description="vector to the target, minus the contribution of gravity")
    gain = Field(Vector3, unit="m/s", description="velocity to gain, minus the contribution of gravity")
    velocity = Field(Vector3, unit="m/s", description="current velocity")
    mass = Field(unit="kg", description="current mass")
    exhaust = Field(unit="m/s", description="exhaust speed of the engine")
    minimum = Field(unit="N", description="least thrust of the engine")
    maximum = Field(unit="N", description="largest thrust of the engine")


class ThrustIntegrals(Record):
    """Integrals and moments of the thrust acceleration under constant thrust."""

    S = Field(
        unit="m", description="integral of the thrust acceleration over the remaining time, weighted by the time left"
    )
    Q = Field(unit="m s", description="first time moment of the integrand of S")
    P = Field(unit="m s2", description="second time moment of the integrand of S")
    J = Field(unit="m", description="first time moment of the thrust acceleration")
    H = Field(unit="m s", description="second time moment of the thrust acceleration, J T - Q")
    K = Field(unit="s", description="time centroid of the thrust acceleration, J/L")


def thrust_integrals(impulse: float, tau: float, time: float, exhaust: float) -> ThrustIntegrals:
    """Return the integrals for an ``impulse`` L (m/s) over ``time`` (s)."""
    first = tau * impulse - exhaust * time
    second = impulse * time - first
    third = second * tau - 0.5 * exhaust * time * time
    fourth = third * tau - exhaust * time * time * time / 6.0
    return ThrustIntegrals(S=second, Q=third, P=fourth, J=first, H=first * time - third, K=first / impulse)


def iterate_steering(s: SteeringState, p: SteeringProblem) -> SteeringState:
    """Return the state after one iteration."""
    gain = norm(p.gain)
    if not (gain > 0.0 and p.mass > 0.0 and s.thrust > 0.0):
        return without_solution(s)
    tau = p.exhaust * p.mass / s.thrust
    time = s.time
    if time > MOST_BURNT * tau:
        time = MOST_BURNT * tau
    if not time > SHORTEST:
        return without_solution(s)
    direction = p.gain / gain
    i = thrust_integrals(p.exhaust * log(tau / (tau - time)), tau, time, p.exhaust)
    square = dot(s.turning, s.turning)
    x = (gain + 0.5 * square * (i.H - i.J * i.K)) / p.exhaust
    if not (x > 0.0 and x < LARGEST_IMPULSE):
        return without_solution(s)
    burnt = -expm1(-x)
    along = dot(p.way, direction) + 0.5 * square * (i.P - 2.0 * i.Q * i.K + i.S * i.K * i.K)
    divisor = p.exhaust * (burnt - x * exp(-x)) + dot(p.velocity, direction) * burnt
    thrust = s.thrust
    if divisor * along > 0.0:
        thrust = clip(p.exhaust * p.mass * divisor / along, LOWEST_OF_MINIMUM * p.minimum, MOST_OF_MAXIMUM * p.maximum)
    tau = p.exhaust * p.mass / thrust
    time = tau * burnt
    if not time > SHORTEST:
        return without_solution(s)
    i = thrust_integrals(p.exhaust * x, tau, time, p.exhaust)
    spread = i.Q - i.S * i.K
    if abs(spread) < SMALLEST_SPREAD * abs(i.S * time):
        return without_solution(s)
    offset = p.way - time * p.velocity
    return SteeringState(
        time=time,
        thrust=thrust,
        direction=direction,
        turning=(offset - dot(offset, direction) * direction) / spread,
        centre=i.K,
        change=abs(time - s.time) / time,
    )


def without_solution(s: SteeringState) -> SteeringState:
    """Return the state marked as having no solution."""
    return replace(s, change=-1.0)


def has_solution(s: SteeringState) -> bool:
    """Return True if the last iteration had a solution."""
    return s.change >= 0.0
