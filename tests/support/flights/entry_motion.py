"""Independent simulation of an entry by numpy, in Cartesian inertial axes and with a quaternion.

It is written from Newton's and Euler's equations, with coefficients by scipy's splines on Newtonian formulas and the
atmosphere by its definition, independent of the FMUs.
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

MU, EARTH_RATE, RADIUS = 3.986e14, 7.29e-5, 6371000.0
MASS, AREA, LENGTH = 2900.0, 3.8, 2.2
INERTIA = np.array([[1400.0, -40.0, 0.0], [-40.0, 1250.0, 0.0], [0.0, 0.0, 1200.0]])
ARM, DAMPING = np.array([-1.335, -0.066353, 0.0]), -0.1
DEGREE = np.pi / 180.0
LAYERS = [(0, -6.5), (11, 0.0), (20, 1.0), (32, 2.8), (47, 0.0), (51, -2.8), (71, -2.0)]


def atmosphere(height):
    """Return density and speed of sound of the US standard atmosphere of 1976 below 86 km, layer by layer."""
    geopotential = 6356.766 * height / (6356766.0 + height)  # km
    temperature, pressure = 288.15, 101325.0
    for number, (base, lapse) in enumerate(LAYERS):
        top = min(geopotential, LAYERS[number + 1][0] if number + 1 < len(LAYERS) else np.inf)
        if lapse:
            warmer = temperature + lapse * (top - base)
            pressure *= (temperature / warmer) ** (9.80665 * 1e3 / (287.053 * lapse))
            temperature = warmer
        else:
            pressure *= np.exp(-9.80665 * 1e3 * (top - base) / (287.053 * temperature))
        if top == geopotential:
            break
    return pressure / (287.053 * temperature), np.sqrt(1.4 * 287.053 * temperature)


class Coefficients:
    """Cx and Cy over Mach number and spatial angle, splines in the angle and straight lines in Mach."""

    def __init__(self, machs, axial, normal):
        knots = np.radians(np.arange(13) * 5.0)
        self.machs = np.array(machs)
        self.axial = [CubicSpline(knots, row, bc_type=((1, 0.0), (2, 0.0))) for row in axial]
        self.normal = [CubicSpline(knots, row, bc_type=((2, 0.0), (2, 0.0))) for row in normal]

    def at(self, mach, angle):
        mach = np.clip(mach, self.machs[0], self.machs[-1])
        angle = min(angle, np.radians(60.0))
        values = [
            np.interp(mach, self.machs, [float(curve(angle)) for curve in kind]) for kind in (self.axial, self.normal)
        ]
        return values[0], values[1]


def frames(place, path):
    """Return rotations: velocity axes and position (unit) in inertial axes that coincide with the Earth's at time 0."""
    _, longitude, latitude = place
    _, angle, course = path
    up = np.array([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)])
    east = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
    north = np.cross(up, east)
    along = np.cos(angle) * (np.cos(course) * east + np.sin(course) * north) + np.sin(angle) * up
    side = np.cross(along, up)
    side /= np.linalg.norm(side)
    return np.array([along, np.cross(side, along), side]), up


def body_from_velocity(bank, sideslip, attack):
    """Rotate axes by attack about z after sideslip about y after bank about x."""
    return (
        Rotation.from_euler("z", -attack) * Rotation.from_euler("y", -sideslip) * Rotation.from_euler("x", -bank)
    ).as_matrix()


class Entry:
    """The capsule in inertial axes: position, velocity, quaternion from body to inertial, angular velocity (body)."""

    def __init__(self, coefficients, torque=(0.0, 0.0, 0.0), air=True):
        self.coefficients, self.torque, self.air = coefficients, np.array(torque), air

    def start(self, place, path, attitude, w):
        axes, up = frames(place, path)
        spin = np.array([0.0, 0.0, EARTH_RATE])
        position = place[0] * up
        velocity = path[0] * axes[0] + np.cross(spin, position)
        body = body_from_velocity(*attitude) @ axes
        return np.concatenate([position, velocity, Rotation.from_matrix(body.T).as_quat(), w])

    def slopes(self, time, state):
        position, velocity, w = state[:3], state[3:6], state[10:]
        quaternion = state[6:10] / np.linalg.norm(state[6:10])
        to_inertial = Rotation.from_quat(quaternion).as_matrix()
        distance = np.linalg.norm(position)
        acceleration = -MU * position / distance**3
        moment = self.torque.copy()
        if self.air:
            against = to_inertial.T @ (velocity - np.cross([0.0, 0.0, EARTH_RATE], position))
            density, sound = atmosphere(distance - RADIUS)
            speed = np.linalg.norm(against)
            across = np.hypot(against[1], against[2])
            axial, normal = self.coefficients.at(speed / sound, np.arctan2(across, against[0]))
            force = 0.5 * density * speed**2 * AREA * np.array([-axial, *(-normal * against[1:] / across)])
            acceleration = acceleration + to_inertial @ force / MASS
            moment = moment + np.cross(ARM, force) + 0.5 * DAMPING * density * speed * AREA * LENGTH**2 * w
        x, y, z, s = quaternion
        rate = 0.5 * np.array(
            [
                s * w[0] + y * w[2] - z * w[1],
                s * w[1] + z * w[0] - x * w[2],
                s * w[2] + x * w[1] - y * w[0],
                -(x * w[0] + y * w[1] + z * w[2]),
            ]
        )
        return np.concatenate(
            [velocity, acceleration, rate, np.linalg.solve(INERTIA, moment - np.cross(w, INERTIA @ w))]
        )

    def fly(self, state, seconds):
        """Return the state after a time, by DOP853 at 1e-13."""
        return solve_ivp(self.slopes, (0.0, seconds), state, "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]

    def read(self, state, time):
        """Return place, path, attitude and w of a state at a time."""
        position, velocity, w = state[:3], state[3:6], state[10:]
        spin = np.array([0.0, 0.0, EARTH_RATE])
        turned = Rotation.from_rotvec(-spin * time)
        fixed, moving = turned.apply(position), turned.apply(velocity - np.cross(spin, position))
        distance, speed = np.linalg.norm(fixed), np.linalg.norm(moving)
        longitude, latitude = np.arctan2(fixed[1], fixed[0]), np.arcsin(fixed[2] / distance)
        up = fixed / distance
        east = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
        angle = np.arcsin(moving @ up / speed)
        course = np.arctan2(moving @ np.cross(up, east), moving @ east)
        place, path = np.array([distance, longitude, latitude]), np.array([speed, angle, course])
        axes, _ = frames(place, path)
        body = (turned * Rotation.from_quat(state[6:10])).as_matrix().T @ axes.T
        attack, sideslip = np.arctan2(-body[1, 0], body[0, 0]), np.arcsin(body[2, 0])
        bank = np.arctan2(-body[2, 1], body[2, 2])
        return place, path, np.array([bank, sideslip, attack]), w
