"""Satellite navigation receiver of position and velocity."""

from ..block import Input, Output, Parameter, State
from ..interfaces.ports import inertial, sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import zeros
from ..mathlib.estimation.sensor_errors import LATEST, make_room, next_markov
from ..mathlib.rng import normals
from ..mathlib.vectors import is_finite
from .random_sensor import RandomSensor

TIME = 6  # column of the time in samples; columns 0 to 2 are position, 3 to 5 velocity
GOOD = 7


class ReceiverStatus(Enumeration):
    """Status of the last sample."""

    GOOD = member("good")
    OUTAGE = member("outage, no sample")
    NOT_FINITE = member("input not finite, no sample")


class GpsReceiver(RandomSensor):
    """Receiver of position and velocity with white noise, a Gauss-Markov position error, and latency.

        r_m = r + e + position_sigma n    v_m = v + velocity_sigma n
        e^+ = f e + markov_sigma sqrt(1 - f^2) n    f = exp(-h/markov_time)

    The Gauss-Markov error starts in its stationary state. A sample arrives ``latency`` sample periods later, with the
    time at which it was taken plus clock_error. During an outage no sample is taken; samples taken earlier still
    arrive. Random numbers depend on seed, stream and sample number only.

    Frame: inertial.

    Assumes errors that do not depend on the visible satellites.

    See docs/systems/earth_pointing.md.
    """

    default_step = 1.0

    position_sigma = Parameter(
        3.0, unit="m", minimum=0.0, description="white noise of the measured position, 1 sigma per axis"
    )
    velocity_sigma = Parameter(
        0.03, unit="m/s", minimum=0.0, description="white noise of the measured velocity, 1 sigma per axis"
    )
    markov_sigma = Parameter(
        5.0, unit="m", minimum=0.0, description="Gauss-Markov error of the measured position, 1 sigma per axis"
    )
    markov_time = Parameter(
        300.0, unit="s", minimum=1e-3, description="correlation time of the Gauss-Markov position error"
    )
    clock_error = Parameter(
        0.0, unit="s", description="constant error of the receiver's clock, included in sample_time"
    )
    latency = Parameter(1, minimum=0, maximum=LATEST, description="delay from measurement to output, in sample periods")
    sample_period = sampling.SAMPLE_PERIOD.parameter(1.0)
    seed, stream = sampling.random_stream()
    position = inertial.POSITION.input("true position relative to the centre of the central body")
    velocity = inertial.VELOCITY.input("true velocity relative to the centre of the central body")
    outage = Input(False, description="true: outage of the receiver, no samples")
    measured_position = inertial.POSITION.output(
        "measured position relative to the centre of the central body", direct=True
    )
    measured_velocity = inertial.VELOCITY.output(
        "measured velocity relative to the centre of the central body", direct=True
    )
    sample_time = Output(
        0.0, unit="s", direct=True, description="time of measurement of the sample, by the receiver's clock"
    )
    sample_count = sampling.SAMPLE_COUNT.output(
        "number of samples received since the start; a change signals a new sample"
    )
    status = Output(ReceiverStatus, direct=True)
    markov = inertial.POSITION.state("Gauss-Markov error of the measured position")
    samples = State(
        zeros(LATEST + 1, 8),
        description="delayed samples, one per row, newest first: inertial position, velocity, time, validity, SI units",
    )
    start_time = sampling.START_TIME.state()
    last_time = State(0.0, unit="s", description="time of the last sample")

    generator = sampling.GENERATOR.state()

    def draw_constants(self) -> None:
        numbers = normals(self.generator)
        self.markov = self.markov_sigma * numbers
        self.last_time = self.start_time

    def measure(self) -> None:
        """Take a sample at the start."""
        self.take(self.start_time)

    def take(self, t: float) -> None:
        """Take a sample at t (s), and output the delayed sample that is due."""
        slow = normals(self.generator)
        position_noise = normals(self.generator)
        velocity_noise = normals(self.generator)
        if t > self.last_time:
            elapsed = t - self.last_time
            self.markov = next_markov(self.markov, elapsed, self.markov_time, self.markov_sigma, slow)
        self.last_time = t
        self.status = ReceiverStatus.GOOD
        if self.outage:
            self.status = ReceiverStatus.OUTAGE
        elif not (is_finite(self.position) and is_finite(self.velocity)):
            self.status = ReceiverStatus.NOT_FINITE
        make_room(self.samples, 8)
        self.samples[0, GOOD] = 0.0
        if self.status == ReceiverStatus.GOOD:
            self.samples[0, 0:3] = self.position + self.markov + self.position_sigma * position_noise
            self.samples[0, 3:6] = self.velocity + self.velocity_sigma * velocity_noise
            self.samples[0, TIME] = t
            self.samples[0, GOOD] = 1.0
        if self.samples[self.latency, GOOD] > 0.0:
            self.measured_position = self.samples[self.latency, 0:3]
            self.measured_velocity = self.samples[self.latency, 3:6]
            self.sample_time = self.samples[self.latency, TIME] + self.clock_error
            self.sample_count = self.sample_count + 1

    def step(self, t: float, h: float) -> None:
        self.take(t + h)
