"""Truths of slews within limits of rate, acceleration and jerk: constant jerks integrated by scipy, rotations by scipy.

Durations are from seven segments by hand: full jerk, full acceleration, and their mirror image, with a coast between
two such ramps. Adopted from the block: three elementary rotations, and the attitude before and after them.
"""

import numpy as np
from scipy.interpolate import PPoly
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check
from tests.support.checks.guidance import rendezvous

ROWS, BEGIN, RATE, ACCELERATION, JERK = 73, 0.55, 0.6, 0.5, 1.0
START, TARGET = Rotation.from_rotvec([0.3, -0.8, 0.5]), Rotation.from_rotvec([1.4, 0.3, -0.9])
FIRST, LAST = np.array([0.1, 0.2, -0.2]), np.array([0.0, -0.12, 0.16])


def profile(jerks, durations, rate):
    """Return the angle over pieces of constant jerk, from an angle of 0 and a rate without acceleration."""
    knots = np.concatenate([[0.0], np.cumsum(durations)])
    acceleration = PPoly(np.array([jerks]), knots).antiderivative()
    first = PPoly(np.full((1, len(jerks)), rate), knots)
    return acceleration.antiderivative(2), first.antiderivative(), knots[-1]


class Leg:
    """A rotation about an axis of the body by pieces of constant jerk."""

    def __init__(self, axis, rate, jerks, durations):
        self.axis = axis
        self.bent, self.straight, self.duration = profile(jerks, durations, rate)
        self.angle = self.at(self.duration)

    def at(self, time):
        return self.bent(time) + self.straight(time)

    def rate(self, time):
        return self.bent.derivative()(time) + self.straight.derivative()(time)

    def rotation(self, time):
        return Rotation.from_rotvec(np.asarray(self.at(time))[..., None] * self.axis)


def ramp(size):
    """Return jerks and durations of a growing rate."""
    bend = min(np.sqrt(size / JERK), ACCELERATION / JERK)
    flat = size / (JERK * bend) - bend
    return [JERK, 0.0, -JERK], [bend, flat, bend]


def seven_arcs(axis, angle, rate, acceleration, jerk):
    """Return seven arcs of constant jerk, all of them with a duration."""
    bend, flat = acceleration / jerk, rate / acceleration - acceleration / jerk
    coast = angle / rate - rate / acceleration - acceleration / jerk
    assert min(flat, coast) > 0.0
    return Leg(axis, 0.0, [jerk, 0.0, -jerk, 0.0, -jerk, 0.0, jerk], [bend, flat, bend, coast, bend, flat, bend])


def slew_jerk_limited():
    """Check a rate that is stopped, a turn at all three limits, another rate that is reached."""
    first, last = np.linalg.norm(FIRST), np.linalg.norm(LAST)
    jerks, durations = ramp(first)
    stop = Leg(FIRST / first, first, [-jerk for jerk in jerks], durations)
    spin = Leg(LAST / last, 0.0, *ramp(last))
    begin = START * Rotation.from_rotvec(BEGIN * FIRST)
    stopped, spinning = begin * stop.rotation(stop.duration), TARGET * spin.rotation(spin.duration).inv()
    turn = (stopped.inv() * spinning).as_rotvec()
    angle = float(np.linalg.norm(turn))
    middle = seven_arcs(turn / angle, angle, RATE, ACCELERATION, JERK)
    legs = [(begin, stop), (stopped, middle), (spinning, spin)]
    ends = BEGIN + np.cumsum([stop.duration, middle.duration, spin.duration])

    def motion(time):
        """Return attitude and angular velocity."""
        if time <= BEGIN:
            return START * Rotation.from_rotvec(time * FIRST), FIRST
        if time >= ends[-1]:
            return TARGET * Rotation.from_rotvec((time - ends[-1]) * LAST), LAST
        number = int(np.searchsorted(ends, time))
        attitude, leg = legs[number]
        since = time - [BEGIN, *ends][number]
        return attitude * leg.rotation(since), leg.rate(since) * leg.axis

    time = STEP * np.arange(ROWS + 1)
    attitudes, rates = zip(*map(motion, time), strict=True)
    quaternion = np.array([attitude.as_quat(scalar_first=True) for attitude in attitudes[:-1]])
    quaternion[0] *= np.sign(quaternion[0] @ START.as_quat(scalar_first=True))
    jumps = np.sign((quaternion[1:] * quaternion[:-1]).sum(axis=1))
    quaternion[1:] *= np.cumprod(jumps)[:, None]
    outputs = {
        "reference_quaternion": quaternion,
        "reference_angular_velocity": np.array(rates[:-1]),
        "reference_angular_acceleration": np.diff(rates, axis=0) / STEP,
        "slew_angle": np.full(ROWS, stop.angle + angle + spin.angle),
        "duration": np.full(ROWS, ends[-1] - BEGIN),
        "phase": np.where(time < BEGIN, 0, np.where(time < ends[-1], 1, 2))[:-1],
        "status": np.zeros(ROWS),
    }
    assert set(outputs["phase"]) == {0, 1, 2}
    return Check(
        truth="pieces of constant jerk integrated by scipy, rotations by scipy",
        step=STEP,
        inputs={"estimated_quaternion": np.tile(3.0 * START.as_quat(scalar_first=True), (ROWS, 1))},
        outputs=outputs,
        tolerances={**dict.fromkeys(outputs, (1e-13, 0.0)), "phase": (0.0, 0.0), "status": (0.0, 0.0)},
        parameters={
            "target_quaternion": -2.0 * TARGET.as_quat(scalar_first=True),
            "slew_start": BEGIN,
            "rate_limit": RATE,
            "acceleration_limit": ACCELERATION,
            "jerk_limit": JERK,
            "start_angular_velocity": FIRST,
            "end_angular_velocity": LAST,
            "sample_period": STEP,
        },
    )


def rendezvous_guidance_jerk_limited():
    """Compute the plan of the other guidance with another turn, which ends before its phase does."""
    check = rendezvous.rendezvous_guidance()
    limits = {"turn_rate_limit": 1.9, "turn_acceleration_limit": 4.0, "turn_jerk_limit": 20.0}
    axis = np.cross([1.0, 0.0, 0.0], rendezvous.SPIN)
    axis, angle = axis / np.linalg.norm(axis), np.arccos(rendezvous.SPIN[0] / np.linalg.norm(rendezvous.SPIN))
    leg = seven_arcs(axis, angle, *limits.values())
    assert leg.duration < rendezvous.TURN_END - rendezvous.TURN_START - 0.2
    time = rendezvous.STEP * np.arange(rendezvous.ROWS) - rendezvous.TURN_START
    since, ahead = (np.clip(t, 0.0, leg.duration) for t in (time, time + 0.5 * rendezvous.ATTITUDE))
    outputs = {
        "planned_quaternion": leg.rotation(since).as_quat(canonical=True, scalar_first=True),
        "planned_angular_velocity": np.outer(leg.rate(since), axis),
        "planned_angular_acceleration": np.outer(leg.bent.derivative(2)(ahead), axis),
        "turn_duration": np.full(rendezvous.ROWS, leg.duration),
    }
    return Check(
        truth="polynomials by their ends, pieces of constant jerk and rotations by scipy",
        step=check.step,
        inputs=check.inputs,
        outputs={**check.outputs, **outputs},
        tolerances={**check.tolerances, **dict.fromkeys(outputs, (2e-13, 0.0))},
        parameters={**check.parameters, **limits},
    )


TRUTHS = {
    "rendezvous_guidance_jerk_limited": rendezvous_guidance_jerk_limited,
    "slew_jerk_limited": slew_jerk_limited,
}
