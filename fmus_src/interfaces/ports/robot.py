"""The free-flying robot: attitude, jets, gyros, and what its plan and its commands count."""

import math

from ...kernel.enumerations import Enumeration, member
from ...mathlib.actuators.gyros import ISOTROPIC_ANGLES
from ...ports import Port
from ...units import deg

LARGEST = 1e100  # a command beyond it counts as not finite; no kernel overflows below it

COMMAND_COUNT = Port(0, description="forces commanded; a change tells a new one")
DELAY_FRACTION = Port(
    0.25, unit="1", minimum=0.0, maximum=1.0, description="delay of the jets over the period of translation control"
)
FAR_SIGMA = Port(0.025, unit="m", minimum=1e-9, description="error of a sample far away, 1 sigma per axis")
GIMBAL_ANGLES = Port(ISOTROPIC_ANGLES, unit="rad", description="gimbal angles")
GIMBAL_RATES = Port([0.0] * 4, unit="rad/s", description="commanded gimbal rates")
JET_ARM = Port([1.0, 0.7, 0.6], unit="m", frame="body", description="place of the first jet")
JET_AZIMUTH = Port(math.pi / 4.0, unit="rad", description="nozzles from x in the xy plane")
JET_THRUST = Port([0.0] * 8, unit="N", description="thrust of each jet, from now on")
JET_TILT = Port(deg(35.25), unit="rad", description="nozzles above the body's xy plane")
MAXIMUM_THRUST = Port(0.5, unit="N", minimum=0.0, description="of one jet")
MEASURED_QUATERNION = Port([1.0, 0.0, 0.0, 0.0], unit="1", description="measured, body to inertial, scalar first")
NEAR_RANGE = Port(300.0, unit="m", minimum=0.0, description="nearby is below this range")
NEAR_SIGMA = Port(0.01, unit="m", minimum=1e-9, description="error of a sample nearby, 1 sigma per axis")
PLANNED_QUATERNION = Port([1.0, 0.0, 0.0, 0.0], unit="1", description="planned, body to inertial, scalar first")
QUATERNION = Port([1.0, 0.0, 0.0, 0.0], unit="1", description="estimated attitude, from body to inertial, scalar first")
RANGE = Port(0.0, unit="m", description="from the robot to the object's centre")
ROTOR_MOMENTUM = Port(30.0, unit="N.m.s", minimum=1e-3, description="angular momentum of one rotor")
SPIN_AXIS = Port([-0.608, 0.228, 0.760], unit="1", frame="inertial", description="of the object, any length")
TRANSLATION_COUNT = Port(0, description="ticks so far; a change tells a new one")
TRANSLATION_PERIOD = Port(8.0, unit="s", minimum=1e-3, description="to the next tick")


class FilterMethod(Enumeration):
    """Estimator of an error from samples."""

    MEAN = member("mean")
    KALMAN = member("Kalman filter")


class ControlLaw(Enumeration):
    """Law that leads an error to 0."""

    LEAD = member("lead compensator")
    PROPORTIONAL_DERIVATIVE = member("error and its rate")


class SampleStatus(Enumeration):
    """Outcome of the last sample."""

    GOOD = member("good")
    NOT_FINITE = member("last sample not finite and left out")
    NO_ATTITUDE = member("no attitude: a quaternion shorter than 0.5 left out")
