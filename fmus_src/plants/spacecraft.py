"""Spacecraft about Earth or Moon: orbit, attitude, wheels and modes with all forces and torques."""

from ..block import Output, Outputs, Parameter, State
from ..interfaces.ports import body, inertial, sampling, satellite, space
from ..kernel.enumerations import Enumeration, member
from ..kernel.integrators import count_steps, runge_kutta_4
from ..kernel.matrices import inverse, is_positive_definite, zeros
from ..kernel.records import Field, Record, replace
from ..mathlib.attitude.quaternion import multiply, normalise, quaternion, to_body, to_reference
from ..mathlib.space.gravity_gradient import gravity_gradient_torque
from ..mathlib.vectors import Vector3, Vector4, clip, cross, finite_or_zero, is_finite, norm, vector
from ..models.elastic_modes import ElasticModes
from ..models.exposed_surfaces import ExposedSurfaces
from ..models.gravity_field import GravityField
from ..models.spinning_wheels import SpinningWheels

FASTEST_MODE = (
    0.7  # rad, largest phase W h of a mode per step, for which Runge-Kutta adds a damping ratio (W h)^5/144 of 1e-3
)


class SpacecraftStatus(Enumeration):
    """Validity of the motion, and limits reached."""

    GOOD = member("good")
    TORQUE_LIMITED = member("a motor torque limited")
    SPEED_LIMITED = member("a wheel at its speed limit")
    DIPOLE_LIMITED = member("a dipole limited")
    NO_NORMAL = member("a plate without normal omitted")
    BELOW_AIR = member("below 100 km, air density of 100 km used")
    MODE_TOO_FAST = member("a mode too fast for the internal step")
    NOT_FINITE = member("an input not finite, taken as 0")
    BELOW_SURFACE = member("below the surface, no motion")
    NO_INERTIA = member("inertia or mass not positive without wheels and modes, no motion")


class SpacecraftMotion(Record):
    """Motion of spacecraft, wheels and modes, or the time derivative of this motion."""

    position = Field(Vector3, unit="m", frame="inertial", description="position of the centre of mass")
    velocity = Field(Vector3, unit="m/s", frame="inertial", description="velocity of the centre of mass")
    quaternion = Field(Vector4, unit="1", description="attitude quaternion from body to inertial, scalar first")
    angular_momentum = Field(
        Vector3,
        unit="N.m.s",
        frame="inertial",
        description="angular momentum of the whole spacecraft about its centre of mass",
    )
    spin = Field(
        Vector4,
        unit="N.m.s",
        description="angular momentum of each wheel about its spin axis, relative to the inertial frame",
    )
    displacements = Field(Vector4, description="modal displacements, m times square root of kg")
    momenta = Field(Vector4, description="modal momenta, m/s times square root of kg")


class StepInputs(Record):
    """Inputs over a step, with values that are not finite replaced by 0."""

    motors = Field(Vector4, unit="N.m", description="commanded torque of each motor on its wheel about the spin axis")
    dipole = Field(Vector3, unit="A.m2", frame="body", description="commanded magnetic dipole moment, within its limit")
    force = Field(Vector3, unit="N", frame="body", description="force at force_point")
    torque = Field(Vector3, unit="N.m", frame="body", description="external torque on the body")
    acceleration = Field(
        Vector3,
        unit="m/s2",
        frame="inertial",
        description="additional acceleration of the whole spacecraft, without excitation of modes",
    )


class Loads(Record):
    """Forces, except gravity, and torques at one instant."""

    force = Field(Vector3, unit="N", frame="body", description="force on the body without gravity")
    torque = Field(Vector3, unit="N.m", frame="body", description="torque about the undeformed centre of mass")
    disturbance = Field(
        Vector3,
        unit="N.m",
        frame="body",
        description="sum of the torques of gravity gradient, drag, solar pressure and residual dipole",
    )


class Spacecraft(GravityField, ExposedSurfaces, SpinningWheels, ElasticModes):
    """Orbit, attitude, four reaction wheels and up to four modes under gravity, air, sunlight and the magnetic field.

    With total angular momentum G in inertial axes, wheel axes A, wheel momenta h, modal displacements η and momenta p,
    participations L and D, mass M, M_e = 1 - L^T L/M and the shift c = L η/M of the centre of mass:

        r' = v    v' = g(r, t) + R(q) F/M + a_ext    q' = q ω/2    G' = R(q) (T - c × F)
        ω = (I - J_s A A^T - D M_e^-1 D^T)^-1 (R(q)^T G - A h - D M_e^-1 p)
        h' = u    η' = M_e^-1 (p - D^T ω)    p' = -L^T F/M - 2 ζ W η' - W^2 η
        T = Σ r_k × F_k + (3 μ/|r|^3) e × (I e) + (m + m_r) × B + T_body

    F is the sum of drag, solar pressure and body_force, e is the direction of r, and m and m_r are the commanded and
    the residual dipole. Without torque G is exactly constant. The motion is integrated by the fourth-order Runge-Kutta
    method in steps of internal_step, or in equal parts of the communication step. Forces are evaluated at every stage;
    the pole axes, Sun and Moon are evaluated once, for the middle of the step.

    To replace a model, derive a class and override `gravity`, `air_density`, `air_velocity`, `surface_load`,
    `flux_density` or `further_torque`.

    Frames: inertial (GCRS axes, origin at the body's centre); body (origin at the undeformed centre of mass).

    Assumes constant mass, and an inertia that includes the wheels, not spinning, and the modes, undeformed.

    Source: Montenbruck and Gill 2000; Likins 1970; Schaub and Junkins 2018. See docs/systems/earth_pointing.md.
    """

    default_step = 0.25

    mass = Parameter(50.0, unit="kg", minimum=1e-3, description="mass of the whole spacecraft")
    inertia = satellite.INERTIA.parameter([4.2, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 3.0])
    wheel_inertia = satellite.WHEEL_INERTIA.parameter(3e-4)
    motor_torque_limit = satellite.MOTOR_TORQUE_LIMIT.parameter(5e-3)
    speed_limit = Parameter(
        1000.0 / 3.0, unit="rad/s", minimum=0.0, description="largest magnitude of a wheel's speed; 0: no limit"
    )
    viscous_friction = Parameter(
        1e-7, unit="N.m.s", minimum=0.0, description="viscous friction coefficient of each wheel"
    )
    coulomb_friction = Parameter(
        1e-5, unit="N.m", minimum=0.0, description="Coulomb friction torque of each wheel above coulomb_band"
    )
    residual_dipole = space.DIPOLE.parameter(
        [0.05, 0.05, 0.05], description="residual magnetic dipole moment of the spacecraft"
    )
    dipole_limit = Parameter(
        5.0,
        unit="A.m2",
        minimum=0.0,
        description="largest magnitude of the commanded magnetic dipole about each body axis",
    )
    force_point = Parameter([0.0, 0.0, 0.0], unit="m", frame="body", description="point of application of body_force")
    initial_position = inertial.POSITION.parameter(
        [6878137.0, 0.0, 0.0],
        description="initial position of the centre of mass relative to the centre of the central body",
    )
    initial_velocity = inertial.VELOCITY.parameter(
        [0.0, -980.4704108126322, 7549.203993067037],
        description="initial velocity of the centre of mass relative to the centre of the central body",
    )
    initial_quaternion = Parameter(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="initial attitude quaternion from body to inertial, scalar first"
    )
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(
        description="initial angular velocity of the body relative to the inertial frame"
    )
    internal_step = sampling.INTERNAL_STEP.parameter(0.25, minimum=1e-3)
    dipole = space.DIPOLE.input("commanded magnetic dipole moment of the torquers")
    body_force = body.FORCE.input("external force at force_point, such as thrust")
    body_torque = body.TORQUE.input("external torque on the body")
    external_acceleration = inertial.ACCELERATION.input(
        "additional acceleration of the whole spacecraft, without excitation of modes"
    )
    orbit = Outputs(space.Orbit)
    attitude = Outputs(space.Attitude)
    angular_momentum = Output(
        [0.0, 0.0, 0.0],
        unit="N.m.s",
        frame="inertial",
        description="angular momentum of the whole spacecraft about its centre of mass",
    )
    specific_force = Output(
        [0.0, 0.0, 0.0],
        unit="m/s2",
        frame="body",
        description="specific force of the spacecraft (non-gravitational force over mass)",
    )
    applied_dipole = space.DIPOLE.output("magnetic dipole moment of the torquers after limitation")
    disturbance_torque = body.TORQUE.output(
        "sum of the torques of gravity gradient, drag, solar pressure and residual dipole"
    )
    status = Output(SpacecraftStatus)
    inverse_inertia = State(
        zeros(3, 3),
        frozen=True,
        description=(
            "inverse of the inertia matrix without the wheels' spin inertia and the modes' contribution, 1/(kg "
            "m2) (body frame)"
        ),
    )
    fastest = State(
        0.0, unit="rad/s", frozen=True, description="highest natural frequency of the modes of the free spacecraft"
    )
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.fill()
        self.fill_gravity()
        self.start_surfaces()
        self.position = self.initial_position
        self.velocity = self.initial_velocity
        self.quaternion = normalise(self.initial_quaternion)
        self.angular_velocity = self.initial_angular_velocity
        self.start_wheels(self.angular_velocity)
        sound = self.start_modes(self.mass)
        locked = self.inertia - self.wheel_inertia * self.axes @ self.axes.T - self.modal_inertia()
        self.inverse_inertia, invertible = inverse(locked)
        if not (sound and invertible and is_positive_definite(locked)):
            self.status = SpacecraftStatus.NO_INERTIA
            return
        inverse_whole, _ = inverse(self.inertia)
        self.fastest = self.largest_frequency(self.mass, inverse_whole)
        self.modal_momenta = self.rotation.T @ self.angular_velocity
        momentum_body = self.inertia @ self.angular_velocity + self.wheel_momentum
        self.angular_momentum = to_reference(self.quaternion, momentum_body)
        self.locate(self.start_time)
        if not norm(self.position) > 0.0 or self.height(self.position) < 0.0:
            self.status = SpacecraftStatus.BELOW_SURFACE
            return
        inputs = self.limit_inputs()
        self.set_outputs(self.start_time, inputs)

    def further_torque(self, t: float, s: SpacecraftMotion) -> Vector3:
        """Return an additional torque (N m, body) of a subclass at simulation time t (s); 0 here."""
        return vector(0.0, 0.0, 0.0)

    def loads(self, t: float, s: SpacecraftMotion, inputs: StepInputs) -> Loads:
        """Return all forces except gravity, and all torques."""
        surface = self.surface_load(t, s.position, s.velocity, s.quaternion)
        position_body = to_body(s.quaternion, s.position)
        disturbance = surface.torque + gravity_gradient_torque(position_body, self.inertia, self.gravity_parameter())
        disturbance = disturbance + self.further_torque(t, s)
        commanded = inputs.torque + cross(self.force_point, inputs.force)
        if norm(inputs.dipole) > 0.0 or norm(self.residual_dipole) > 0.0:
            field_body = to_body(s.quaternion, self.flux_density(t, s.position))
            disturbance = disturbance + cross(self.residual_dipole, field_body)
            commanded = commanded + cross(inputs.dipole, field_body)
        return Loads(force=surface.force + inputs.force, torque=disturbance + commanded, disturbance=disturbance)

    def rate(self, s: SpacecraftMotion) -> Vector3:
        """Return the angular velocity (rad/s, body)."""
        carried = self.axes @ s.spin + self.modal_coupling @ s.momenta
        return self.inverse_inertia @ (to_body(s.quaternion, s.angular_momentum) - carried)

    def derivatives(self, t: float, s: SpacecraftMotion, inputs: StepInputs) -> SpacecraftMotion:
        """Return the time derivative of the motion."""
        w = self.rate(s)
        loads = self.loads(t, s, inputs)
        acceleration_body = loads.force / self.mass
        velocities = self.modal_velocities(s.momenta, w)
        centre = self.displaced_centre(s.displacements, self.mass)
        fall = self.gravity(t, s.position) + self.third_body_gravity(s.position) + inputs.acceleration
        return SpacecraftMotion(
            position=s.velocity,
            velocity=fall + to_reference(s.quaternion, acceleration_body),
            quaternion=multiply(s.quaternion, quaternion(0.0, 0.5 * w)),
            angular_momentum=to_reference(s.quaternion, loads.torque - cross(centre, loads.force)),
            spin=inputs.motors + self.drags(self.speeds(s.spin, w)),
            displacements=velocities,
            momenta=self.modal_forces(s.displacements, velocities, acceleration_body),
        )

    def limit_inputs(self) -> StepInputs:
        """Return the inputs, with 0 for values that are not finite and a limited dipole; set status and applied_dipole.

        The motor torques are returned as commanded, without their limits.
        """
        commands = self.motor_torques
        finite = is_finite(self.dipole) and is_finite(self.body_force) and is_finite(self.body_torque)
        finite = finite and is_finite(self.external_acceleration)
        if not (is_finite(commands[1:4]) and is_finite(vector(commands.w, 0.0, 0.0))):
            finite = False
            commands = vector(0.0, 0.0, 0.0, 0.0)
        commanded = finite_or_zero(self.dipole)
        self.applied_dipole = vector(
            clip(commanded.x, -self.dipole_limit, self.dipole_limit),
            clip(commanded.y, -self.dipole_limit, self.dipole_limit),
            clip(commanded.z, -self.dipole_limit, self.dipole_limit),
        )
        self.status = SpacecraftStatus.GOOD
        if norm(self.applied_dipole - commanded) > 0.0:
            self.status = SpacecraftStatus.DIPOLE_LIMITED
        if self.lacks_normal:
            self.status = SpacecraftStatus.NO_NORMAL
        if self.is_below_air(self.position):
            self.status = SpacecraftStatus.BELOW_AIR
        if self.fastest * self.internal_step > FASTEST_MODE:
            self.status = SpacecraftStatus.MODE_TOO_FAST
        if not finite:
            self.status = SpacecraftStatus.NOT_FINITE
        return StepInputs(
            motors=commands,
            dipole=self.applied_dipole,
            force=finite_or_zero(self.body_force),
            torque=finite_or_zero(self.body_torque),
            acceleration=finite_or_zero(self.external_acceleration),
        )

    def motion(self) -> SpacecraftMotion:
        """Return the present motion as a record."""
        return SpacecraftMotion(
            position=self.position,
            velocity=self.velocity,
            quaternion=self.quaternion,
            angular_momentum=self.angular_momentum,
            spin=self.spin,
            displacements=self.mode_displacements,
            momenta=self.modal_momenta,
        )

    def set_outputs(self, t: float, inputs: StepInputs) -> None:
        """Set the outputs from the motion at t (s)."""
        s = self.motion()
        self.angular_velocity = self.rate(s)
        self.set_wheel_outputs(self.angular_velocity)
        loads = self.loads(t, s, inputs)
        self.specific_force = loads.force / self.mass
        self.disturbance_torque = loads.disturbance

    def move(self, t: float, h: float, inputs: StepInputs) -> None:
        """Advance the motion by h (s) under inputs with commanded motor torques."""
        torque_limited, speed_limited = self.drive(inputs.motors)
        if torque_limited and self.status == SpacecraftStatus.GOOD:
            self.status = SpacecraftStatus.TORQUE_LIMITED
        if speed_limited and self.status <= SpacecraftStatus.TORQUE_LIMITED:
            self.status = SpacecraftStatus.SPEED_LIMITED
        self.locate(t + 0.5 * h)
        end = runge_kutta_4(self.derivatives, t, self.motion(), h, replace(inputs, motors=self.applied_torques))
        self.position = end.position
        self.velocity = end.velocity
        self.quaternion = normalise(end.quaternion)
        self.angular_momentum = end.angular_momentum
        self.spin = end.spin
        self.mode_displacements = end.displacements
        self.modal_momenta = end.momenta
        self.set_outputs(t + h, inputs)

    def step(self, t: float, h: float) -> None:
        if self.status >= SpacecraftStatus.BELOW_SURFACE:
            return
        inputs = self.limit_inputs()
        steps = count_steps(h, self.internal_step)
        for k in range(steps):
            self.move(t + float(k) * h / float(steps), h / float(steps), inputs)
            if self.height(self.position) < 0.0:
                self.status = SpacecraftStatus.BELOW_SURFACE
                return
