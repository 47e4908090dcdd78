"""Ports of the free-flying robot: attitude, jets, gyros, plan and commands."""

import math

from ...kernel.enumerations import Enumeration, member
from ...mathlib.actuators.gyros import ISOTROPIC_ANGLES
from ...ports import Port
from ...units import deg

LARGEST = 1e100  # larger commands count as not finite; smaller ones cause no overflow in kernels

COMMAND_COUNT = Port(0, description="number of force commands since the start; a change signals a new command")
DELAY_FRACTION = Port(
    0.25,
    unit="1",
    minimum=0.0,
    maximum=1.0,
    description="delay from a command to the jets' thrust, as a fraction of the translation control period",
)
FAR_SIGMA = Port(
    0.025, unit="m", minimum=1e-9, description="error of measured relative position beyond near_range, 1 sigma per axis"
)
GIMBAL_ANGLES = Port(ISOTROPIC_ANGLES, unit="rad", description="gimbal angles of the control moment gyros")
GIMBAL_RATES = Port([0.0] * 4, unit="rad/s", description="commanded gimbal rates of the control moment gyros")
JET_ARM = Port(
    [1.0, 0.7, 0.6], unit="m", frame="body", description="position of the first jet relative to the centre of mass"
)
JET_AZIMUTH = Port(math.pi / 4.0, unit="rad", description="angle of the nozzles from the x axis in the body's xy plane")
JET_THRUST = Port([0.0] * 8, unit="N", description="commanded thrust of each jet")
JET_TILT = Port(deg(35.25), unit="rad", description="elevation of the nozzles above the body's xy plane")
MAXIMUM_THRUST = Port(0.5, unit="N", minimum=0.0, description="largest thrust of one jet")
MEASURED_QUATERNION = Port(
    [1.0, 0.0, 0.0, 0.0], unit="1", description="measured attitude quaternion from body to inertial, scalar first"
)
NEAR_RANGE = Port(
    300.0, unit="m", minimum=0.0, description="distance to the object below which near_sigma replaces far_sigma"
)
NEAR_SIGMA = Port(
    0.01, unit="m", minimum=1e-9, description="error of measured relative position within near_range, 1 sigma per axis"
)
PLANNED_QUATERNION = Port(
    [1.0, 0.0, 0.0, 0.0], unit="1", description="planned attitude quaternion from body to inertial, scalar first"
)
QUATERNION = Port(
    [1.0, 0.0, 0.0, 0.0], unit="1", description="estimated attitude quaternion from body to inertial, scalar first"
)
RANGE = Port(0.0, unit="m", description="distance from the robot to the object's centre")
ROTOR_MOMENTUM = Port(
    30.0, unit="N.m.s", minimum=1e-3, description="angular momentum of each gyro rotor about its spin axis"
)
SPIN_AXIS = Port([-0.608, 0.228, 0.760], unit="1", frame="inertial", description="spin axis of the object (any length)")
TRANSLATION_COUNT = Port(
    0, description="number of translation control samples since the start; a change signals a new sample"
)
TRANSLATION_PERIOD = Port(8.0, unit="s", minimum=1e-3, description="time to the next translation control sample")


class FilterMethod(Enumeration):
    """Method by which an error is estimated from samples."""

    MEAN = member("mean")
    KALMAN = member("Kalman filter")


class ControlLaw(Enumeration):
    """Control law for an error."""

    LEAD = member("lead compensator")
    PROPORTIONAL_DERIVATIVE = member("PD law")


class SampleStatus(Enumeration):
    """Status of the last sample."""

    GOOD = member("good")
    NOT_FINITE = member("last sample not finite and skipped")
    NO_ATTITUDE = member("no attitude: quaternion shorter than 0.5 skipped")
