"""Control of the orbital attitude by pole placement with state-derivative feedback."""

from ..block import Parameter, State
from ..interfaces.ports import body
from ..kernel.matrices import Matrix, diagonal, identity, inverse, zeros
from ..mathlib.orbits.attitude import (
    ANGLES,
    PITCH,
    RATES,
    ROLL,
    angle_rates,
    angular_acceleration,
    evaluate_angles,
    linear_model,
)
from ..mathlib.vectors import vector
from .orbital_control import OrbitalControl

SINGULAR = 1e9  # A counts as singular if the product of the largest elements of A and A^-1 exceeds this number


class OrbitalDerivativeControl(OrbitalControl):
    """State-derivative feedback of angle rates and angular acceleration, with placed poles.

        u = u_0 - K (a', ω')    K = K_x (A - B K_x)^-1
        a' = S_1 a + z    z' = S_0 z

    K_x is the gain of the modal law for the matrices S_1 and S_0, which contain minus the poles on their diagonals and
    a coupling of roll and pitch. a' is computed from the estimate; ω' is its mean since the last finite estimate. u_0
    balances the products of inertia, which no derivative contains.

    The poles withstand the delay of ω' only if 1 - G_w has eigenvalues of positive real part, where

        u = J G_w ω'

    With two unstable modes this condition requires the coupling. If it is not met, the status reports unusable
    parameters. Torques too small for a pulse do not appear in ω', so the law is for wheels, or for pulses with
    pulses.mean set. It is linear in yaw.

    Assumes a nonsingular A.

    Source: Lapin, thesis, section 1.3.4, by name; condition: Michiels, Vyhlidal, Huijberts and Nijmeijer 2009. See
    docs/systems/orbital_attitude.md.
    """

    angle_poles = OrbitalControl.angle_poles.with_start([0.0015, 0.003, 0.0015])
    rate_poles = OrbitalControl.rate_poles.with_start([0.0015, 0.003, 0.0015])
    coupling = Parameter(
        0.0026, unit="rad/s", description="coupling rate of roll into pitch, for the angles and for their deviations"
    )
    angle_gain = State(
        [0.0] * 9,
        columns=3,
        description="gain matrix from time derivatives of the angles to torque, N m s/rad (body frame)",
    )
    rate_gain = State(
        [0.0] * 9, columns=3, description="gain matrix from angular acceleration to torque, N m s2 (body frame)"
    )
    torque_at_rest = body.TORQUE.state("torque that holds the body at rest in the orbital frame")
    last_angular_velocity = body.ANGULAR_VELOCITY.state("angular velocity at the previous sample")
    last_time = State(
        0.0, unit="s", frozen=True, description="time from the start of the simulation to the previous sample"
    )

    def decay(self, poles: Matrix) -> Matrix:
        """Return the matrix S of a level: minus the poles (1/s) on the diagonal, and the coupling of roll and pitch."""
        s = -poles
        s[ROLL, PITCH] = -self.coupling
        s[PITCH, ROLL] = self.coupling
        return s

    def is_stable_with_delay(self, e: Matrix) -> bool:
        """Return True if all three eigenvalues of e have positive real parts (Hurwitz's condition on -e)."""
        trace = e[0, 0] + e[1, 1] + e[2, 2]
        xy = e[0, 0] * e[1, 1] - e[0, 1] * e[1, 0]
        xz = e[0, 0] * e[2, 2] - e[0, 2] * e[2, 0]
        yz = e[1, 1] * e[2, 2] - e[1, 2] * e[2, 1]
        determinant = (
            e[0, 0] * yz
            - e[0, 1] * (e[1, 0] * e[2, 2] - e[1, 2] * e[2, 0])
            + e[0, 2] * (e[1, 0] * e[2, 1] - e[1, 1] * e[2, 0])
        )
        return trace > 0.0 and determinant > 0.0 and trace * (xy + xz + yz) > determinant

    def largest(self, a: Matrix) -> float:
        """Return the largest magnitude of the elements of a 6 x 6 matrix."""
        size = 0.0
        for i in range(6):
            for j in range(6):
                if abs(a[i, j]) > size:
                    size = abs(a[i, j])
        return size

    def begin(self) -> None:
        a = linear_model(self.inertia, self.inverse_inertia, self.orbital_rate)
        back, invertible = inverse(a)
        s1 = self.decay(diagonal(self.angle_poles))
        s0 = self.decay(diagonal(self.rate_poles))
        n = s1 - a[ANGLES, ANGLES]
        closed = zeros(6, 6)
        closed[ANGLES, ANGLES] = a[ANGLES, ANGLES]
        closed[ANGLES, RATES] = identity(3)
        closed[RATES, ANGLES] = n @ a[ANGLES, ANGLES] - s0 @ n
        closed[RATES, RATES] = n + s0
        undone, placed = inverse(closed)
        # u = J (closed - a) x in the rows of the rates, with x = closed^-1 x'
        gain = identity(6) - a @ undone
        self.angle_gain = self.inertia @ gain[RATES, ANGLES]
        self.rate_gain = self.inertia @ gain[RATES, RATES]
        self.usable = invertible and placed and self.is_stable_with_delay(identity(3) - gain[RATES, RATES])
        if not self.largest(a) * self.largest(back) < SINGULAR:
            self.usable = False
        zero = vector(0.0, 0.0, 0.0)
        down = vector(0.0, 0.0, -self.orbital_rate)
        self.torque_at_rest = -(
            self.inertia
            @ angular_acceleration(
                evaluate_angles(zero), down, zero, self.inertia, self.inverse_inertia, self.orbital_rate
            )
        )
        self.last_angular_velocity = self.estimated_angular_velocity
        self.last_time = 0.0

    def regulate(self, time: float) -> None:
        w = self.estimated_angular_velocity
        self.torque_command = self.torque_at_rest
        since = time - self.last_time
        if since > 0.0:
            rates = angle_rates(evaluate_angles(self.estimated_angles), w, self.orbital_rate)
            acceleration = (w - self.last_angular_velocity) / since
            self.torque_command = self.torque_at_rest + self.angle_gain @ rates + self.rate_gain @ acceleration
        self.last_angular_velocity = w
        self.last_time = time
