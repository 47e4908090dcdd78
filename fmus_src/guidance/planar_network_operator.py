"""Planar descent by a network operator."""

from ..block import Output, Parameter
from ..interfaces.ports import landing, sampling
from ..kernel.enumerations import Enumeration, member
from .network_operator_law import NetworkOperatorLaw


class LawStatus(Enumeration):
    """Status of the law."""

    GOOD = member("good")
    BAD_LAW = member("matrix is not a network operator, no thrust")


class PlanarNetworkOperator(NetworkOperatorLaw):
    """Thrust and thrust angle of a planar descent, by a network operator.

    Angles are measured from the local vertical, with the same sign as in planar_moon_lander. If the matrix is not a
    network operator, the thrust is 0 and the status 1. The law does not end by itself: it guides to final_altitude and
    a speed of a few m/s, from where another guidance takes over.

    Source: Diveev, Pupkov and Sofronova 2013. See docs/systems/lunar_descent_2d.md.
    """

    final_altitude = Parameter(1500.0, unit="m", description="target altitude of the descent")
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.0, "sample period of the guidance; 0: a sample at every communication point"
    )
    measured_path_angle = landing.MEASURED_PATH_ANGLE.input()
    measured_altitude = landing.MEASURED_ALTITUDE.input("measured altitude of the lander", start=18148.0)
    thrust_angle = landing.THRUST_ANGLE.output(direct=True)
    thrust = landing.THRUST.output(direct=True)
    status = Output(LawStatus, direct=True)

    def initialize(self) -> None:
        self.decode_law()
        if self.edge_count < 0:
            self.status = LawStatus.BAD_LAW
        self.command()

    def command(self) -> None:
        """Set thrust and angle for the measured inputs."""
        if self.status != LawStatus.BAD_LAW:
            self.evaluate_law(self.measured_path_angle, self.measured_altitude, self.final_altitude)
            self.thrust_angle = self.law_angle()
            self.thrust = self.law_thrust()

    def step(self, t: float, h: float) -> None:
        self.command()
