"""Base of full-order observers with one gain for angles and rates."""

from ..block import State
from ..kernel.matrices import Matrix
from ..mathlib.orbits.attitude import YAW, AttitudeState, index_of_measured
from ..mathlib.vectors import Vector3, vector
from .attitude_observer import AttitudeObserver


class FullAttitudeObserver(AttitudeObserver, interface=True):
    """Observer of all six states, with a constant gain on the measured states: roll, pitch and angular velocity.

    With the measurement matrix C and the unit vector e of yaw, gains have the form

        K = M (C^T + e l)

    where the matrix M sets the dynamics of the measured states' errors, and the row l corrects yaw by the roll
    residual.
    """

    gain = State(
        [0.0] * 30,
        columns=5,
        description="observer gain from measured roll, pitch and angular rates to angles and angular rates, SI units",
    )

    def compose(self, m: Matrix, row: list) -> None:
        """Set gain = m (C' + e row) for a matrix m (6 x 6) and a row of five elements."""
        for i in range(6):
            for j in range(5):
                self.gain[i, j] = m[i, index_of_measured(j)] + m[i, YAW] * row[j]

    def correction(self, s: AttitudeState, roll: float, pitch: float, rates: Vector3) -> AttitudeState:
        """Return the correction gain (m - C x) of a state x by a sample m (roll, pitch, rates)."""
        missing = [0.0] * 5
        missing[0] = roll - s.angles.x
        missing[1] = pitch - s.angles.z
        for k in range(3):
            missing[2 + k] = rates[k] - s.angular_velocity[k]
        change = [0.0] * 6
        for i in range(6):
            for j in range(5):
                change[i] = change[i] + self.gain[i, j] * missing[j]
        return AttitudeState(angles=vector(*change[0:3]), angular_velocity=vector(*change[3:6]))
