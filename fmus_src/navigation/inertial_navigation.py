"""Base of navigation blocks that integrate an inertial sensor."""

from ..block import State
from ..interfaces.navigation import Navigation
from ..interfaces.ports import sampling
from ..mathlib.estimation.inertial import dead_reckon
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import vector


class InertialNavigation(Navigation, interface=True):
    """Dead reckoning from velocity increments under central gravity, from an initial estimate with errors.

    With the mean specific force f over the step h and f_b over the previous step, and gravity g at r and g_1 at r + h
    v:

        v^+ = v + h (f + (g + g_1)/2)    r^+ = r + h (v + v^+)/2 - (h^2/12) (f - f_b)

    The estimate is propagated at every communication point. Between inertial samples the increment is extrapolated with
    the last specific force, and the next sample corrects the difference. The initial estimate is the truth with errors
    of first_position_sigma and first_velocity_sigma; equal seed and stream give equal errors. Samples present at the
    start are used. In free flight the specific force is 0 and inertial samples are ignored.

    Frame: landing site, not rotating; the Moon's centre is moon_radius below the origin.

    Assumes a specific force that is linear in time over an inertial sample.

    See docs/systems/lunar_navigation.md.
    """

    seed, stream = sampling.random_stream()
    force = State(
        [0.0] * 3, unit="m/s2", frame="landing site", description="mean specific force assumed over the last step"
    )
    force_before = State(
        [0.0] * 3,
        unit="m/s2",
        frame="landing site",
        description="mean specific force assumed over the step before the last step",
    )
    under_way = State(False, description="true: estimate propagated at least once")
    last_force = State(
        [0.0] * 3,
        unit="m/s2",
        frame="landing site",
        description="last measured specific force, assumed until the next sample",
    )
    assumed_increment = State(
        [0.0] * 3,
        unit="m/s",
        frame="landing site",
        description="velocity increment assumed since the last inertial sample",
    )
    since_sample = State(0.0, unit="s", description="time since the last inertial sample")
    inertial_taken = State(0, description="inertial_count of the last inertial sample used")
    altitude_taken = State(0, description="altitude_count of the last altitude sample used")
    velocity_taken = State(0, description="velocity_count of the last velocity sample used")
    position_taken = State(0, description="position_count of the last position sample used")

    def initialise_estimate(self) -> None:
        """Initialise the estimate: truth plus initial errors."""
        generator = [0.0] * 6
        seed_streams(generator, self.seed, self.stream)
        errors = [0.0] * 6
        for i in range(3):
            errors[i] = normal(generator)
            errors[3 + i] = normal(generator)
        self.estimated_position = self.position + self.first_position_sigma * vector(*errors[0:3])
        self.estimated_velocity = self.velocity + self.first_velocity_sigma * vector(*errors[3:6])
        self.inertial_taken = self.inertial_count

    def sense(self, h: float) -> None:
        """Set ``force`` to the mean specific force (m/s2) over the last h (s), measured or extrapolated."""
        self.since_sample = self.since_sample + h
        self.force_before = self.force
        if self.free_flight:
            self.pass_over()
        elif self.inertial_count != self.inertial_taken:
            self.force = (self.velocity_increment - self.assumed_increment) / h
            self.last_force = self.velocity_increment / self.since_sample
            self.assumed_increment = vector(0.0, 0.0, 0.0)
            self.inertial_taken = self.inertial_count
            self.since_sample = 0.0
            self.sample_count = self.sample_count + 1
        else:
            self.force = self.last_force
            self.assumed_increment = self.assumed_increment + h * self.last_force

    def pass_over(self) -> None:
        """Set the specific force to 0, and skip a new inertial sample."""
        self.force = vector(0.0, 0.0, 0.0)
        self.last_force = self.force
        self.assumed_increment = self.force
        self.since_sample = 0.0
        if self.inertial_count != self.inertial_taken:
            self.inertial_taken = self.inertial_count
            self.sample_count = self.sample_count + 1

    def move(self, h: float) -> None:
        """Propagate the estimate by h (s) with the mean specific force."""
        if not self.under_way:
            self.under_way = True
            self.force_before = self.force
        self.estimated_position, self.estimated_velocity = dead_reckon(
            self.estimated_position,
            self.estimated_velocity,
            self.force,
            self.force_before,
            self.moon_radius,
            self.gravitational_parameter,
            h,
        )
