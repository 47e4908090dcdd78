"""A spacecraft about Earth or Moon: its motion, and what surrounds it."""

from ...bundles import Bundle
from ...kernel.enumerations import Enumeration, member
from ...ports import Port
from . import body, inertial, robot

EPOCH = Port(827301600.0, unit="s", description="TT since J2000.0 at simulation time 0")
TT_MINUS_UT1 = Port(69.184, unit="s", description="TT - UT1; UTC for UT1 is within 0.9 s")
DIPOLE = Port([0.0, 0.0, 0.0], unit="A.m2", frame="body", description="magnetic dipole")
MAGNETIC_FIELD = Port([0.0, 0.0, 0.0], unit="T", frame="body", description="magnetic flux density")


class CelestialBody(Enumeration):
    """Body that the spacecraft circles."""

    EARTH = member("Earth")
    MOON = member("Moon")


class Atmosphere(Enumeration):
    """Model of the density of the air, about the Earth alone."""

    VACUUM = member("no air")
    EXPONENTIAL = member("exponential by height")
    HARRIS_PRIESTER = member("Harris-Priester with the bulge behind the Sun")


class Orbit(Bundle):
    """Translation of the centre of mass, from the centre of the body that it circles."""

    position = inertial.POSITION
    velocity = inertial.VELOCITY


class Attitude(Bundle):
    """Rotation relative to inertial axes."""

    quaternion = robot.QUATERNION
    angular_velocity = body.ANGULAR_VELOCITY


class SpaceEnvironment(Bundle):
    """Light, field and air at the spacecraft."""

    sun_direction = Port([1.0, 0.0, 0.0], unit="1", frame="inertial", description="to the Sun, from the spacecraft")
    sun_distance = Port(1.5e11, unit="m", description="to the Sun, from the spacecraft")
    moon_position = Port(
        [0.0, 0.0, 0.0], unit="m", frame="inertial", description="of the Moon, from the centre of the body"
    )
    illumination = Port(1.0, unit="1", description="visible share of the Sun's disk; 0: in the shadow of the body")
    magnetic_field = Port([0.0, 0.0, 0.0], unit="T", frame="inertial", description="magnetic flux density")
    magnetic_field_body = MAGNETIC_FIELD
    density = Port(0.0, unit="kg/m3", description="density of the air")
    planet_angle = Port(0.0, unit="rad", description="turn of the body's prime meridian from the axes of its pole")


class MagneticMode(Enumeration):
    """Task of the torquers."""

    OFF = member("off")
    DETUMBLE = member("brake the rotation")
    UNLOAD = member("unload the wheels")


class PointingMode(Enumeration):
    """Attitude to follow."""

    NADIR = member("local vertical, local horizontal")
    SUN = member("panel towards the Sun")
    INERTIAL = member("fixed attitude")
