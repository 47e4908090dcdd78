"""Capsule that enters the Earth's atmosphere and turns by jet pulses."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, entry, landing, sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import atan2
from ..kernel.integrators import count_steps, runge_kutta_4
from ..kernel.matrices import Matrix, inverse
from ..kernel.records import replace
from ..mathlib.actuators.pulses import left_after, lengths_of, next_switch_off
from ..mathlib.cubic_spline import cubic_value, curvatures
from ..mathlib.entry.gost_atmosphere import gost_air
from ..mathlib.entry.motion import (
    EntryState,
    attitude_rates,
    body_axes,
    earth_forces,
    evaluate_path,
    in_body,
    path_rate,
    velocity_axes_rate,
)
from ..mathlib.entry.newtonian_cap import cap_tables
from ..mathlib.entry.standard_atmosphere import Air, air
from ..mathlib.vectors import Vector3, cross, norm, vector
from ..units import deg

KNOTS = 13
MACHS = 10
ANGLE_STEP = deg(5.0)  # distance between the knots of the tables
HEAD_ON = 1e-9  # sine of the spatial angle of attack below which the aerodynamic roll is taken as 0
MACH_NUMBERS = [1.2, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 30.0]
AXIAL, NORMAL = cap_tables(1.1, 2.235, MACH_NUMBERS, [5.0 * k for k in range(KNOTS)])


class CapsuleStatus(Enumeration):
    """Validity of the aerodynamic tables and of the inertia."""

    GOOD = member("good")
    BEYOND_TABLES = member("beyond the tables")
    NO_INERTIA = member("inertia matrix singular")


class Atmosphere(Enumeration):
    """Model of the standard atmosphere."""

    US_1976 = member("US standard atmosphere 1976")
    GOST_4401_81 = member("GOST 4401-81")


class EntryCapsule(Block):
    """Rigid capsule in the atmosphere of a rotating spherical Earth, with jets about its axes and constant mass.

    With radius r, longitude λ, latitude φ, speed V relative to the Earth, flight path angle θ (up), course χ (from
    east, counter-clockwise from above), Earth rate Ω, and the sum F of aerodynamic force, gravity F_g, Coriolis force
    F_c and transport force F_t in velocity axes:

        r' = V sin θ    λ' = V cos χ cos θ/(r cos φ)    φ' = (V/r) sin χ cos θ
        V' = F_x/m    θ' = (V/r) cos θ + F_y/(m V)    χ' = -(V/r) cos θ cos χ tan φ - F_z/(m V cos θ)
        F_g = -(m μ/r^2) (sin θ, cos θ, 0)
        F_c = 2 m V Ω (0, cos φ cos χ, cos θ sin φ - sin θ cos φ sin χ)
        F_t = m Ω^2 r cos φ (cos φ sin θ - sin φ cos θ sin χ, cos φ cos θ + sin φ sin θ sin χ, sin φ cos χ)

    With bank γ, sideslip β, angle of attack α, and angular velocity n relative to velocity axes:

        γ' = (n_x cos α - n_y sin α)/cos β    β' = n_x sin α + n_y cos α    α' = n_z - tan β (n_x cos α - n_y sin α)
        J ω' = (J ω) × ω + M_air + M_jets

    With velocity v relative to the air, dynamic pressure p and pressure_arm d:

        F_air = p S (-C_x, -C_y v_y/s, -C_y v_z/s)    s = |(v_y, v_z)|    M_air = d × F_air + m_q p S l^2 ω/|v|

    Axial and normal coefficients C_x, C_y are splines in the spatial angle of attack, linear in Mach number; beyond the
    tables the coefficients keep their last values and the status is 1. The air has the density of a standard atmosphere
    times density_factor and moves with the wind.

    A change of pulse_count signals new pulses, which replace the remaining ones at once and end exactly, whatever the
    communication step. mean_torque is added to them. The motion is integrated by the fourth-order Runge-Kutta method in
    steps of at most internal_step.

    Frames: velocity (x along the velocity, y up in the vertical plane through it, z = x × y); body (x along the axis of
    symmetry, out through the heat shield), rotated from velocity axes by bank, sideslip and angle of attack.

    Assumes constant inertia, and jets without rise time.

    Source: Lapin, thesis, chapter 1.2. See docs/systems/entry_attitude.md.
    """

    default_step = 0.2

    mass = landing.MASS.parameter(2900.0, minimum=1e-3, description="constant mass of the capsule")
    inertia = body.INERTIA.parameter()
    reference_area = Parameter(
        3.8, unit="m2", minimum=0.0, description="reference area of the aerodynamic force coefficients"
    )
    reference_length = Parameter(
        2.2, unit="m", minimum=0.0, description="reference length of the aerodynamic damping moment"
    )
    pressure_arm = Parameter(
        [-1.335, -0.066353, 0.0],
        unit="m",
        frame="body",
        description="vector from the centre of mass to the centre of pressure",
    )
    damping_coefficient = Parameter(
        -0.1, unit="1", description="coefficient of the aerodynamic damping moment about each body axis"
    )
    mach_numbers = Parameter(
        MACH_NUMBERS, unit="1", minimum=0.0, description="Mach numbers of the coefficient tables, ascending"
    )
    axial_coefficient = Parameter(
        AXIAL,
        columns=KNOTS,
        unit="1",
        description=(
            "axial force coefficient along -x of the body frame, one row per Mach number, columns for total "
            "angles of attack from 0 to 60 deg"
        ),
    )
    normal_coefficient = Parameter(
        NORMAL,
        columns=KNOTS,
        unit="1",
        description=(
            "normal force coefficient perpendicular to x, one row per Mach number, columns for total angles of "
            "attack from 0 to 60 deg"
        ),
    )
    jet_torque = Parameter(
        [100.0, 100.0, 80.0, 80.0, 80.0, 80.0],
        unit="N.m",
        minimum=0.0,
        description="torque of each jet, in the order +x, -x, +y, -y, +z, -z of the body axes",
    )
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter(
        3.986e14, "gravitational parameter of the Earth"
    )
    atmosphere = Parameter(Atmosphere, start=Atmosphere.US_1976)
    earth_rate = Parameter(7.29e-5, unit="rad/s", description="rotation rate of the Earth about its axis")
    earth_radius = Parameter(
        6371000.0, unit="m", minimum=1.0, description="radius of the sphere above which height is measured"
    )
    initial_height = Parameter(100000.0, unit="m", description="initial height above the sphere of earth_radius")
    initial_longitude = Parameter(deg(60.0), unit="rad", description="initial longitude of the capsule")
    initial_latitude = Parameter(deg(45.0), unit="rad", description="initial latitude of the capsule")
    initial_speed = Parameter(
        7620.0, unit="m/s", minimum=1e-3, description="initial speed of the capsule relative to the rotating Earth"
    )
    initial_path_angle = Parameter(
        deg(-1.45), unit="rad", description="initial flight path angle, positive above the horizon"
    )
    initial_course = Parameter(
        deg(40.0), unit="rad", description="initial course, from east, counter-clockwise as seen from above"
    )
    initial_bank = Parameter(deg(60.0), unit="rad", description="initial bank angle of the capsule")
    initial_sideslip = Parameter(0.0, unit="rad", description="initial sideslip angle of the capsule")
    initial_attack = Parameter(deg(-20.0), unit="rad", description="initial angle of attack of the capsule")
    initial_angular_velocity = body.ANGULAR_VELOCITY.parameter(
        description="initial angular velocity of the capsule relative to the inertial frame"
    )
    final_height = Parameter(
        25000.0, unit="m", description="height above the sphere of earth_radius below which the simulation ends"
    )
    internal_step = sampling.INTERNAL_STEP.parameter(0.025)
    pulse_lengths = body.PULSES.input()
    pulse_count = body.PULSE_COUNT.input()
    mean_torque = body.TORQUE.input("torque of the jets in addition to the pulses, constant over a step")
    wind = entry.WIND.input()
    density_factor = entry.DENSITY_FACTOR.input()
    jet_factor = entry.JET_FACTOR.input()
    height = Output(100000.0, unit="m", description="height of the capsule above the sphere of earth_radius")
    longitude = Output(0.0, unit="rad", description="longitude of the capsule")
    latitude = Output(0.0, unit="rad", description="latitude of the capsule")
    speed = Output(0.0, unit="m/s", description="speed of the capsule relative to the rotating Earth")
    path_angle = Output(0.0, unit="rad", description="flight path angle of the capsule, positive above the horizon")
    course = Output(
        0.0, unit="rad", description="course of the capsule, from east, counter-clockwise as seen from above"
    )
    bank = entry.BANK.output()
    sideslip = Output(0.0, unit="rad", description="sideslip angle of the capsule")
    attack = Output(0.0, unit="rad", description="angle of attack of the capsule")
    angular_velocity = body.ANGULAR_VELOCITY.output()
    dynamic_pressure = entry.DYNAMIC_PRESSURE.output()
    mach = Output(0.0, unit="1", description="Mach number of the capsule relative to the air")
    fired_pulses = body.PULSES.output("lengths of the last fired pulses about x, y and z, signed as the torque")
    jet_seconds = body.PULSES.output("accumulated firing time of the jets about x, y and z")
    total_jet_seconds = Output(
        0.0, unit="s", description="accumulated firing time of all jets, proportional to the propellant used"
    )
    finished = landing.FINISHED.output("true: capsule below final_height, simulation to be ended")
    status = Output(CapsuleStatus)
    state = State(EntryState, radius=6471000.0, speed=7620.0)
    inverse_inertia = State(
        [0.0] * 9, columns=3, description="inverse of the capsule's inertia matrix, 1/(kg m2) (body frame)"
    )
    axial_curvature = State(
        [0.0] * 130, columns=KNOTS, description="second derivatives of the splines of the axial coefficient, 1/rad2"
    )
    normal_curvature = State(
        [0.0] * 130, columns=KNOTS, description="second derivatives of the splines of the normal coefficient, 1/rad2"
    )
    left = State(
        [0.0, 0.0, 0.0],
        unit="s",
        frame="body",
        description="remaining lengths of the current pulses about x, y and z, signed as the torque",
    )
    counted = State(0, description="pulse_count of the last accepted pulses")

    def initialize(self) -> None:
        self.inverse_inertia, invertible = inverse(self.inertia)
        if not invertible:
            self.status = CapsuleStatus.NO_INERTIA
        for k in range(MACHS):
            curvatures(self.axial_coefficient, k, KNOTS, ANGLE_STEP, True, self.axial_curvature)
            curvatures(self.normal_coefficient, k, KNOTS, ANGLE_STEP, False, self.normal_curvature)
        self.state = EntryState(
            radius=self.earth_radius + self.initial_height,
            longitude=self.initial_longitude,
            latitude=self.initial_latitude,
            speed=self.initial_speed,
            flight_path_angle=self.initial_path_angle,
            heading=self.initial_course,
            attitude=vector(self.initial_bank, self.initial_sideslip, self.initial_attack),
            angular_velocity=self.initial_angular_velocity,
        )
        self.publish()

    def coefficient(self, values: Matrix, second: Matrix, mach: float, angle: float) -> float:
        """Return an aerodynamic coefficient at a Mach number and a total angle of attack (rad)."""
        if mach <= self.mach_numbers[0]:
            return cubic_value(values, second, 0, KNOTS, ANGLE_STEP, angle)
        if mach >= self.mach_numbers[MACHS - 1]:
            return cubic_value(values, second, MACHS - 1, KNOTS, ANGLE_STEP, angle)
        k = 0
        for i in range(1, MACHS - 1):
            if not mach >= self.mach_numbers[i]:
                break
            k = i
        fraction = (mach - self.mach_numbers[k]) / (self.mach_numbers[k + 1] - self.mach_numbers[k])
        below = cubic_value(values, second, k, KNOTS, ANGLE_STEP, angle)
        above = cubic_value(values, second, k + 1, KNOTS, ANGLE_STEP, angle)
        return below + fraction * (above - below)

    def standard_air(self, h: float) -> Air:
        """Return the standard atmosphere's density and speed of sound at the height h (m)."""
        if self.atmosphere == Atmosphere.GOST_4401_81:
            return gost_air(h)
        return air(h)

    def spatial_angle(self, v: Vector3) -> float:
        """Return the angle (rad) between the axis of symmetry and the velocity v relative to the air (m/s, body)."""
        return atan2(math.sqrt(v.y * v.y + v.z * v.z), v.x)

    def air_force(self, v: Vector3, gas: Air) -> Vector3:
        """Return the aerodynamic force (N, body) at the velocity v (m/s, body) relative to the air."""
        across = math.sqrt(v.y * v.y + v.z * v.z)
        speed = norm(v)
        angle = self.spatial_angle(v)
        mach = speed / gas.speed_of_sound
        pushed = 0.5 * gas.density * speed * speed * self.reference_area
        axial = self.coefficient(self.axial_coefficient, self.axial_curvature, mach, angle)
        normal = self.coefficient(self.normal_coefficient, self.normal_curvature, mach, angle)
        if across < HEAD_ON * speed:
            return pushed * vector(-axial, normal, 0.0)
        return pushed * vector(-axial, -normal * v.y / across, -normal * v.z / across)

    def derivatives(self, t: float, s: EntryState, torque: Vector3) -> EntryState:
        """Return the time derivative of the state under a torque of the jets (N m, body)."""
        functions = evaluate_path(s)
        axes = body_axes(s.attitude)
        air_velocity_body = in_body(axes, vector(s.speed, 0.0, 0.0) - self.wind)
        standard = self.standard_air(s.radius - self.earth_radius)
        gas = replace(standard, density=standard.density * self.density_factor)
        force_body = self.air_force(air_velocity_body, gas)
        speed = norm(air_velocity_body)
        length = self.reference_length
        damping = 0.5 * self.damping_coefficient * gas.density * speed * self.reference_area * length * length
        w = s.angular_velocity
        moment_body = cross(self.pressure_arm, force_body) + damping * w + torque
        acceleration_velocity = (force_body.x * axes.x + force_body.y * axes.y + force_body.z * axes.z) / self.mass
        acceleration_velocity = acceleration_velocity + earth_forces(
            s, functions, self.gravitational_parameter, self.earth_rate
        )
        path = path_rate(s, functions, acceleration_velocity)
        relative_rate_body = w - in_body(axes, velocity_axes_rate(s, functions, path, self.earth_rate))
        return EntryState(
            radius=path.radius,
            longitude=path.longitude,
            latitude=path.latitude,
            speed=path.speed,
            flight_path_angle=path.flight_path_angle,
            heading=path.heading,
            attitude=attitude_rates(s.attitude, relative_rate_body),
            angular_velocity=self.inverse_inertia @ (cross(self.inertia @ w, w) + moment_body),
        )

    def jet(self, positive: int, negative: int, length: float, time: float) -> float:
        """Return the torque (N m) of an axis's two jets at ``time`` (s) after the start of a pulse of signed
        ``length`` (s).
        """
        if length > time:
            return self.jet_factor[positive] * self.jet_torque[positive]
        if length < -time:
            return -self.jet_factor[negative] * self.jet_torque[negative]
        return 0.0

    def advance_motion(self, t: float, h: float) -> None:
        """Advance the motion by h (s), divided where a pulse ends."""
        time = 0.0
        while time < h:
            end = next_switch_off(self.left, time, h)
            x = self.jet(0, 1, self.left.x, time)
            y = self.jet(2, 3, self.left.y, time)
            z = self.jet(4, 5, self.left.z, time)
            torque = vector(x, y, z) + self.mean_torque
            pieces = count_steps(end - time, self.internal_step)
            for _ in range(pieces):
                self.state = runge_kutta_4(self.derivatives, t + time, self.state, (end - time) / float(pieces), torque)
            time = end

    def publish(self) -> None:
        """Set the outputs from the state."""
        s = self.state
        self.height = s.radius - self.earth_radius
        self.longitude = s.longitude
        self.latitude = s.latitude
        self.speed = s.speed
        self.path_angle = s.flight_path_angle
        self.course = s.heading
        self.bank, self.sideslip, self.attack = s.attitude
        self.angular_velocity = s.angular_velocity
        gas = self.standard_air(self.height)
        self.dynamic_pressure = 0.5 * gas.density * self.speed * self.speed
        v = in_body(body_axes(s.attitude), vector(self.speed, 0.0, 0.0) - self.wind)
        self.mach = norm(v) / gas.speed_of_sound
        if self.status != CapsuleStatus.NO_INERTIA:
            self.status = CapsuleStatus.GOOD
            outside = self.mach < self.mach_numbers[0] or self.mach > self.mach_numbers[MACHS - 1]
            if outside or self.spatial_angle(v) > ANGLE_STEP * float(KNOTS - 1):
                self.status = CapsuleStatus.BEYOND_TABLES
        self.finished = self.height < self.final_height

    def step(self, t: float, h: float) -> None:
        if self.pulse_count != self.counted:
            self.counted = self.pulse_count
            self.left = self.pulse_lengths
            self.fired_pulses = self.pulse_lengths
        if self.status != CapsuleStatus.NO_INERTIA:
            self.advance_motion(t, h)
        before = lengths_of(self.left)
        self.left = left_after(self.left, h)
        self.jet_seconds = self.jet_seconds + before - lengths_of(self.left)
        self.total_jet_seconds = self.jet_seconds.x + self.jet_seconds.y + self.jet_seconds.z
        self.publish()
