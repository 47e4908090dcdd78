"""Tracking law of a plan: projections by matrices, the engine's lag by the matrix exponential.

Adopted from the block: gains and limits, outputs in idle mode, and estimation of thrust at the mean mass of a cycle,
before planning.
"""

import numpy as np
from scipy.linalg import expm

from tests.support.checks.guidance.hover.plan import DESCEND, GOOD, IDLE, UNPLANNED, Plan, make_plan
from tests.support.checks.guidance.hover.programme import POLYNOMIAL
from tests.support.checks.guidance.hover.vehicle import EXHAUST, LAG, MAXIMUM, MINIMUM, weight

COASTING, BRAKING, HOLDING, DAMPING, FILTER = 0.06, 0.15, 0.12, 0.9, 0.7  # rad/s, 1, s
LARGEST_ERROR, LARGEST_TILT = 40.0, np.tan(np.deg2rad(12.0))  # m, 1
DESCENT = 0.3, 1.0  # m/s2, m/s
NOTHING = {
    "thrust_acceleration": 0.0,
    "thrust_direction_rate": np.zeros(3),
    "time_to_go": 0.0,
    "status": GOOD,
    "finished": False,
    "angular_acceleration_feed": np.zeros(3),
    "plan_time": 0.0,
    "saturated": False,
    "plan_kind": UNPLANNED,
    "predicted_propellant": 0.0,
    "programme": np.zeros(5),
}
FIRST = NOTHING | {
    "thrust_direction": np.array([0.0, 0.0, 1.0]),
    "burn_duration": 1e9,
    "answered_plan": 0,
    "thrust_factor": 1.0,
    "reference_position": np.zeros(3),
    "reference_velocity": np.zeros(3),
}


def shorten(vector, longest):
    return vector * min(1.0, longest / max(np.linalg.norm(vector), 1e-300))


class Law:
    """Samples of the guidance one after the other; ``cycle`` (s) is nominal."""

    def __init__(self, cycle):
        self.cycle = cycle
        self.plan: Plan | None = None
        self.start = self.engine = self.command = 0.0
        self.tilt, self.outputs = np.zeros(3), dict(FIRST)

    def reference(self, time):
        """Return position (m) and velocity (m/s) of the plan."""
        t = time - self.start
        if self.mode == DESCEND and self.plan.status == GOOD:
            acceleration, speed = DESCENT
            sunk = 0.5 * acceleration * (t**2 - max(t - speed / acceleration, 0.0) ** 2)
            return self.plan.goal - sunk * self.plan.up, -min(acceleration * t, speed) * self.plan.up
        return self.plan.motion(t)

    def estimate(self, elapsed, observed):
        """Estimate thrust over its command, after an engine of first order."""
        system = np.array([[-1.0 / LAG, 0.0, self.command / LAG], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
        self.engine, impulse, _ = expm(elapsed * system) @ [self.engine, 0.0, 1.0]
        mean_mass = observed.mass + 0.5 * impulse / EXHAUST
        measured = mean_mass * np.linalg.norm(observed.velocity_increment) / impulse
        gain = 0.1 if impulse > 0.3 * MAXIMUM * elapsed else 0.02
        if abs(measured - 1.0) < 0.5:
            self.outputs["thrust_factor"] += gain * (measured - self.outputs["thrust_factor"])

    def sample(self, time, elapsed, observed, kind=None):
        """Return outputs at ``time`` (s); ``kind`` as in `make_plan`."""
        self.outputs["command_time"] = time
        if not observed.active or observed.mode == IDLE:
            self.plan, self.command = None, 0.0
            self.outputs |= NOTHING
            return dict(self.outputs)
        if self.plan:
            self.estimate(elapsed, observed)
        else:
            measured = observed.mass * np.linalg.norm(observed.velocity_increment) / elapsed
            self.tilt, self.engine = np.zeros(3), measured / self.outputs["thrust_factor"]
        if not self.plan or observed.mode != self.mode or observed.plan_number != self.outputs["answered_plan"]:
            self.plan, self.start, self.mode = make_plan(observed, elapsed, kind), time, observed.mode
        self.outputs |= self.track(time - self.start, self.reference(time), elapsed, observed)
        return dict(self.outputs)

    def frequency(self, t):
        plan = self.plan
        if plan.kind in (UNPLANNED, POLYNOMIAL) or t >= plan.duration:
            return HOLDING
        return COASTING if t < plan.duration - plan.times[3] - 1.0 else BRAKING

    def track(self, t, reference, elapsed, observed):
        """Return the command at ``t`` (s) after the plan's start."""
        plan, w = self.plan, self.frequency(t)
        direction, rate = plan.direction(t)
        error = reference[0] - observed.position
        f = w**2 * shorten(error, LARGEST_ERROR) + 2.0 * DAMPING * w * (reference[1] - observed.velocity)
        size = plan.mean_thrust(t + LAG, self.cycle, weight(observed.position)) + f @ direction
        demand = (np.eye(3) - np.outer(direction, direction)) @ f / max(size, 1.0)
        lateral = shorten(demand, LARGEST_TILT)
        self.tilt = lateral + np.exp(-elapsed / FILTER) * (self.tilt - lateral)
        length = np.linalg.norm(direction + self.tilt)
        axis = (direction + self.tilt) / length
        acceleration = max(size, 0.02) * length / self.outputs["thrust_factor"]
        self.command = np.clip(observed.mass * acceleration, MINIMUM, MAXIMUM)
        shortened = np.linalg.norm(error) > LARGEST_ERROR or np.linalg.norm(demand) > LARGEST_TILT
        return {
            "thrust_acceleration": acceleration,
            "thrust_direction": axis,
            "thrust_direction_rate": (np.eye(3) - np.outer(axis, axis)) @ rate / length,
            "time_to_go": max(plan.duration - t, 0.0),
            "status": plan.status,
            "finished": t >= plan.duration and not (observed.mode == DESCEND and plan.status == GOOD),
            "angular_acceleration_feed": (plan.angular_rate(t + self.cycle) - plan.angular_rate(t)) / self.cycle,
            "answered_plan": observed.plan_number,
            "plan_time": t,
            "reference_position": reference[0],
            "reference_velocity": reference[1],
            "saturated": shortened or self.command != observed.mass * acceleration,
            "plan_kind": plan.kind,
            "predicted_propellant": plan.propellant,
            "programme": np.array(plan.times),
        }
