"""Dipole of magnetorquers for detumbling and wheel unloading."""

from ..block import Block, Input, Output, Parameter, State
from ..interfaces.ports import body, sampling, satellite, space
from ..interfaces.ports.space import MagneticMode
from ..kernel.enumerations import Enumeration, member
from ..mathlib.vectors import Vector3, cross, dot, is_finite, vector

WEAKEST_FIELD = 1e-6  # T, below which no dipole is commanded


class MagneticControlStatus(Enumeration):
    """Status of the last dipole command."""

    GOOD = member("good")
    LIMITED = member("dipole limited")
    WEAK_FIELD = member("field below 1e-6 T, no dipole")
    NOT_FINITE = member("an input not finite, no dipole")


class MagneticControl(Block):
    """B-dot law for detumbling, and cross-product law for unloading wheels, by magnetic torquers.

    With the last field sample B, the sample B_last a time T earlier, and the wheels' momentum h:

        m = -(k/|B|^2) (B - B_last)/T    detumble
        m = (k_u/|B|^2) (h - h_0) × B    unload

    The unloading torque m × B removes the momentum across the field. A dipole beyond dipole_limit is scaled as a whole.
    The dipole acts for active_fraction of T and is 0 when the next sample is taken. feedforward_torque is -(m × B)
    while wheels are unloaded. With orbital rate n, inclination i to the magnetic equator and least moment of inertia
    J_min the best gain is

        k = 2 n (1 + sin i) J_min

    Frame: body.

    Assumes torquers without lag, and field samples field_period apart.

    Source: Stickler and Alfriend 1976; Avanzini and Giulietti 2012; Markley and Crassidis 2014, section 7.5. See
    docs/systems/earth_pointing.md.
    """

    default_step = 0.25

    detumble_gain = Parameter(0.0132, unit="N.m.s", minimum=0.0, description="gain k of the B-dot law for detumbling")
    unload_gain = Parameter(
        0.002, unit="1/s", minimum=0.0, description="gain ku of the cross-product law for wheel unloading"
    )
    target_momentum = body.ANGULAR_MOMENTUM.parameter(
        description="target angular momentum of the wheels relative to the body"
    )
    dipole_limit = Parameter(
        5.0,
        unit="A.m2",
        minimum=0.0,
        description="largest magnitude of the commanded magnetic dipole about each body axis",
    )
    field_period = Parameter(1.0, unit="s", minimum=1e-3, description="sample period T of the magnetometer")
    active_fraction = Parameter(
        0.75,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        description="fraction of the sample period T during which the dipole acts",
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.25, "sample period of the control; 0: a sample at every communication point"
    )
    mode = Input(MagneticMode)
    measured_field = space.MAGNETIC_FIELD.input("measured magnetic flux density")
    field_count = Input(0, description="number of magnetometer samples since the start; a change signals a new sample")
    wheel_momentum = satellite.WHEEL_MOMENTUM.input("angular momentum of the wheels relative to the body")
    dipole = space.DIPOLE.output("commanded magnetic dipole moment of the torquers", direct=True)
    feedforward_torque = body.TORQUE.output(
        "torque command for the wheels that compensates the magnetic torque", direct=True
    )
    status = Output(MagneticControlStatus, direct=True)
    counted = State(0, description="field_count of the last magnetometer sample used")
    previous_field = space.MAGNETIC_FIELD.state("magnetic flux density of the previous sample")
    has_field = State(False, description="true: at least one magnetometer sample received")
    planned_dipole = space.DIPOLE.state("magnetic dipole moment commanded at the last sample")
    active_until = State(0.0, unit="s", description="time until which the commanded dipole acts")
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.counted = self.field_count - 1
        self.command(self.start_time)

    def plan(self, field: Vector3) -> Vector3:
        """Return the dipole (A m2, body) for a new field sample (T, body), before limiting."""
        square = dot(field, field)
        if self.mode == MagneticMode.DETUMBLE and self.has_field:
            return -(self.detumble_gain / (square * self.field_period)) * (field - self.previous_field)
        if self.mode == MagneticMode.UNLOAD:
            return self.unload_gain / square * cross(self.wheel_momentum - self.target_momentum, field)
        return vector(0.0, 0.0, 0.0)

    def take_sample(self, t: float) -> None:
        """Compute the dipole for a new field sample."""
        field = self.measured_field
        self.planned_dipole = vector(0.0, 0.0, 0.0)
        self.active_until = t + self.active_fraction * self.field_period
        if not (is_finite(field) and is_finite(self.wheel_momentum)):
            self.status = MagneticControlStatus.NOT_FINITE
            self.has_field = False
            return
        self.status = MagneticControlStatus.WEAK_FIELD
        if dot(field, field) >= WEAKEST_FIELD * WEAKEST_FIELD:
            self.status = MagneticControlStatus.GOOD
            dipole = self.plan(field)
            largest = 0.0
            for i in range(3):
                if abs(dipole[i]) > largest:
                    largest = abs(dipole[i])
            if largest > self.dipole_limit:
                self.status = MagneticControlStatus.LIMITED
                dipole = self.dipole_limit * (dipole / largest)
            self.planned_dipole = dipole
        self.previous_field = field
        self.has_field = True

    def command(self, t: float) -> None:
        """Set the outputs at t (s)."""
        if self.field_count != self.counted:
            self.counted = self.field_count
            self.take_sample(t)
        self.dipole = vector(0.0, 0.0, 0.0)
        self.feedforward_torque = vector(0.0, 0.0, 0.0)
        if self.mode != MagneticMode.OFF and t < self.active_until - sampling.TIME_ROUNDING:
            self.dipole = self.planned_dipole
            if self.mode == MagneticMode.UNLOAD:
                self.feedforward_torque = -cross(self.dipole, self.previous_field)

    def step(self, t: float, h: float) -> None:
        self.command(t + h)
