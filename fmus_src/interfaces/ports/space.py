"""Ports of a spacecraft about Earth or Moon: motion and environment."""

from ...bundles import Bundle
from ...kernel.enumerations import Enumeration, member
from ...ports import Port
from . import body

EPOCH = Port(827301600.0, unit="s", description="Terrestrial Time at simulation time 0, since J2000.0")
TT_MINUS_UT1 = Port(
    69.184, unit="s", description="Terrestrial Time minus UT1; with UTC in place of UT1 the error is at most 0.9 s"
)
DIPOLE = Port([0.0, 0.0, 0.0], unit="A.m2", frame="body", description="magnetic dipole moment of the torquers")
MAGNETIC_FIELD = Port([0.0, 0.0, 0.0], unit="T", frame="body", description="magnetic flux density at the spacecraft")


class CelestialBody(Enumeration):
    """Central body of the orbit."""

    EARTH = member("Earth")
    MOON = member("Moon")


class Atmosphere(Enumeration):
    """Model of the Earth's air density."""

    VACUUM = member("no air")
    EXPONENTIAL = member("exponential in height")
    HARRIS_PRIESTER = member("Harris-Priester with diurnal bulge")


class Orbit(Bundle):
    """Position and velocity of the centre of mass, relative to the centre of the central body."""

    position = Port(
        [0.0, 0.0, 0.0],
        unit="m",
        frame="inertial",
        description="position of the centre of mass relative to the centre of the central body",
    )
    velocity = Port(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="inertial",
        description="velocity of the centre of mass relative to the centre of the central body",
    )


class Attitude(Bundle):
    """Attitude and angular velocity relative to the inertial frame."""

    quaternion = Port(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="attitude quaternion from body to inertial, scalar first"
    )
    angular_velocity = body.ANGULAR_VELOCITY


class SpaceEnvironment(Bundle):
    """Sunlight, magnetic field and air at the spacecraft."""

    sun_direction = Port(
        [1.0, 0.0, 0.0], unit="1", frame="inertial", description="direction from the spacecraft to the Sun, unit vector"
    )
    sun_distance = Port(1.5e11, unit="m", description="distance from the spacecraft to the Sun")
    moon_position = Port(
        [0.0, 0.0, 0.0],
        unit="m",
        frame="inertial",
        description="position of the Moon relative to the centre of the central body",
    )
    illumination = Port(
        1.0, unit="1", description="visible fraction of the Sun's disk; 0: full shadow, 1: full sunlight"
    )
    magnetic_field = Port(
        [0.0, 0.0, 0.0], unit="T", frame="inertial", description="magnetic flux density at the spacecraft"
    )
    magnetic_field_body = MAGNETIC_FIELD
    density = Port(0.0, unit="kg/m3", description="air density at the spacecraft")
    planet_angle = Port(
        0.0, unit="rad", description="rotation angle of the central body's prime meridian about its pole"
    )


class MagneticMode(Enumeration):
    """Mode of the magnetic torquers."""

    OFF = member("off")
    DETUMBLE = member("detumble")
    UNLOAD = member("unload the wheels")


class PointingMode(Enumeration):
    """Mode of the reference attitude."""

    NADIR = member("local vertical, local horizontal")
    SUN = member("panel towards the Sun")
    INERTIAL = member("fixed attitude")
