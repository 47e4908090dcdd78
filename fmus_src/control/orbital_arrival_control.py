"""Control of the orbital attitude with simultaneous arrival of all angles."""

import math

from ..mathlib.orbits.attitude import angle_rates, evaluate_angles
from ..mathlib.vectors import vector
from .orbital_control import OrbitalControl

LEAST_RATE_CHANGE = 0.3  # fraction of the commanded rate; a smaller change does not warrant a pulse


class OrbitalArrivalControl(OrbitalControl):
    """Arrival of all angles at arrival_time with minimum rotation: one pulse to start, a coast, one pulse to stop.

    The commanded rate e_c' of an angle error e brings it to its band in the remaining time, assumed to be at least
    least_time:

        e_c' = -sgn(e) max(|e| - band, 0)/max(arrival_time - t, least_time)

    A torque is commanded only where the rate error warrants a pulse. From turn_start on, yaw turns to turn_angle (0: no
    turn) and back, which makes gyro biases observable.

    See docs/systems/orbital_attitude.md.
    """

    def lead_yaw(self, time: float) -> tuple[float, float]:
        """Return the commanded yaw (rad) and its rate (rad/s) at ``time`` (s) after the start."""
        ramp = abs(self.turn_angle) / self.turn_rate
        rate = math.copysign(self.turn_rate, self.turn_angle)
        since = time - self.turn_start
        back = since - ramp - self.turn_stay
        if since <= 0.0 or back >= ramp:
            return 0.0, 0.0
        if since < ramp:
            return rate * since, rate
        if back <= 0.0:
            return self.turn_angle, 0.0
        return self.turn_angle - rate * back, -rate

    def torque_about(self, k: int, error: float, led: float, rate: float, time: float) -> float:
        """Return the torque (N m) about axis k for an angle error (rad) and the commanded and actual rates (rad/s)."""
        left = self.arrival_time - time
        if left < self.least_time:
            left = self.least_time
        beyond = abs(error) - self.band[k]
        required_rate = led
        if beyond > 0.0:
            required_rate = led - math.copysign(beyond, error) / left
        change = required_rate - rate
        mobility = self.inverse_inertia[k, k]
        worth = LEAST_RATE_CHANGE * abs(required_rate)
        minimum = mobility * self.jet_torque[k] * self.shortest_pulse
        if worth < minimum:
            worth = minimum
        if abs(change) > worth:
            return change / (mobility * self.sample_period)
        return 0.0

    def regulate(self, time: float) -> None:
        yaw, led = self.lead_yaw(time)
        rates = angle_rates(evaluate_angles(self.estimated_angles), self.estimated_angular_velocity, self.orbital_rate)
        x = self.torque_about(0, self.estimated_angles.x, 0.0, rates.x, time)
        y = self.torque_about(1, self.estimated_angles.y - yaw, led, rates.y, time)
        z = self.torque_about(2, self.estimated_angles.z, 0.0, rates.z, time)
        self.torque_command = vector(x, y, z)
