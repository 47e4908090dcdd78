"""Tracking of a descent plan: reference motion and correction of deviations. Kernel functions."""

from ...vectors import Vector3, clip, limit_length, norm, vector
from .expansion import GRAVITY, POSITION, THRUST, VELOCITY, vector_of
from .problem import INTERVALS

FREQUENCY = 0.15  # rad/s, natural frequency of the errors
DAMPING = 0.9  # damping ratio of the errors
CORRECTION = 0.12  # largest correction, as a fraction of the largest thrust
WEAK = 0.3  # fraction of the largest thrust below which the thrust of a plan is weak, as in coasts
COAST_CORRECTION = (
    0.7  # largest correction of a weak thrust, as a fraction of it, so that its direction is not reversed
)


def interval_at(step: float, elapsed: float) -> int:
    """Return the index of the plan's interval, of length ``step`` (s), at ``elapsed`` (s) after its start."""
    k = 0
    for i in range(1, INTERVALS):
        if elapsed >= float(i) * step:
            k = i
    return k


def reference(plan: list, step: float, elapsed: float) -> tuple[Vector3, Vector3]:
    """Return a plan's position (m) and velocity (m/s) at ``elapsed`` (s) after its start; intervals take ``step``
    (s).
    """
    k = interval_at(step, elapsed)
    time = elapsed - float(k) * step
    u = vector_of(plan, THRUST + 3 * k)
    here = vector_of(plan, GRAVITY + 3 * k)
    change = vector_of(plan, GRAVITY + 3 * k + 3) - here
    r = vector_of(plan, POSITION + 3 * k)
    v = vector_of(plan, VELOCITY + 3 * k)
    square = time * time
    position = r + time * v + 0.5 * square * (u + here) + square * time / (6.0 * step) * change
    return position, v + time * (u + here) + square / (2.0 * step) * change


def mean_thrust(plan: list, step: float, elapsed: float, span: float) -> Vector3:
    """Return the mean thrust acceleration (m/s2) of a plan over ``span`` (s) from ``elapsed`` (s) on.

    Before its start a plan has its first thrust, after its end its last thrust.
    """
    k = interval_at(step, elapsed)
    end = elapsed + span
    if k == INTERVALS - 1 or not end > float(k + 1) * step:
        return vector_of(plan, THRUST + 3 * k)
    total = vector(0.0, 0.0, 0.0)
    for i in range(INTERVALS):
        begin = clip(float(i) * step, elapsed, end)
        close = clip(float(i + 1) * step, elapsed, end)
        if i == INTERVALS - 1:
            close = end
        total = total + (close - begin) * vector_of(plan, THRUST + 3 * i)
    return total / span


def tracking_thrust(feedforward: Vector3, position_error: Vector3, velocity_error: Vector3, largest: float) -> Vector3:
    """Return the thrust acceleration (m/s2) for tracking a plan.

    ``feedforward`` (m/s2) is the plan's thrust acceleration; ``position_error`` (m) and ``velocity_error`` (m/s) are
    planned minus actual values; ``largest`` (m/s2) is the largest thrust over mass.
    """
    correction = FREQUENCY * FREQUENCY * position_error + 2.0 * DAMPING * FREQUENCY * velocity_error
    limit = CORRECTION * largest
    size = norm(feedforward)
    if size < WEAK * largest and COAST_CORRECTION * size < limit:
        limit = COAST_CORRECTION * size
    return feedforward + limit_length(correction, limit)
