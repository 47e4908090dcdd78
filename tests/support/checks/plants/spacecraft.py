"""Truth of a spacecraft: accelerations of body, wheels and modes from one linear system, with the full environment."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.plants.motion import fly
from tests.support.checks.space import celestial, harmonics, surroundings
from tests.support.checks.vectors import unit

ROWS, INTERNAL = 33, 1.0 / 64.0
EPOCH, TT_MINUS_UT1, BULGE, DENSITY_FACTOR = 827330000.0, 69.3, 3.0, 1.7
GRAVITY_DEGREE, MAGNETIC_DEGREE = 5, 4
MASS, SPIN = 52.0, 3e-4
INERTIA = np.array([[4.2, -0.3, 0.1], [-0.3, 4.0, 0.2], [0.1, 0.2, 3.0]])
AXES = unit([[1.0, 0.2, 0.5], [-0.3, 1.2, 0.4], [-0.9, -0.2, 0.6], [0.1, -1.0, 0.8]])
FACTOR, TORQUE_LIMIT = np.array([0.02, 0.9, 1.1, 0.3]), 5e-3
VISCOUS, COULOMB, BAND = 1e-6, 2e-5, 8.0
RESIDUAL, DIPOLE_LIMIT = np.array([0.05, -0.08, 0.03]), 4.0
POINT = np.array([0.1, -0.2, 0.3])
PLATES = np.array([
    [0.48, 2.0, 0.0, 0.0, 0.3, 0.01, 0.02, 2.2, 0.3, 0.2],
    [0.48, 0.0, 1.0, 0.0, 0.0, 0.31, 0.0, 2.1, 0.3, 0.2],
    [0.36, 0.0, 0.0, -3.0, 0.01, 0.0, -0.4, 2.2, 0.1, 0.4],
    [0.9, 0.6, 0.0, 0.8, 0.0, -0.9, 0.1, 2.4, 0.1, 0.1],
    [0.7, -0.6, -0.8, 0.0, 0.2, 0.9, 0.1, 2.4, 0.2, 0.1],
])  # fmt: skip
SPHERE_AREA, SPHERE_DRAG, SPHERE_REFLECTIVITY = 0.3, 2.0, 1.4
# By mode: frequency (0: none), damping, participations.
FREQUENCY, DAMPING = np.array([1.1, 0.0, 1.9, 0.0]), np.array([0.02, 0.1, 0.005, 0.1])
TRANSLATION = np.array([[2.0, 0.5, 0.0], [1.0, 1.0, 1.0], [0.0, -1.0, 1.5], [0.0, 0.0, 0.0]])
ROTATION = np.array([[0.1, 0.9, -0.2], [1.0, 0.0, 0.0], [0.6, 0.0, 0.1], [0.0, 0.0, 0.0]])
MODES = FREQUENCY > 0.0
W, L, D = FREQUENCY[MODES], TRANSLATION[MODES].T, ROTATION[MODES].T


def matrix_of(q):
    """Return the rotation from body to inertial axes."""
    w, x, y, z = q
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2.0 * w * skew + 2.0 * skew @ skew


def start_of_flight():
    """Return position and velocity inside the half-shadow of the Earth, on a circle towards the light."""
    sun = unit(celestial.sun(EPOCH))
    across = unit(np.cross(np.cross(sun, [0.3, -0.5, 1.0]), sun))
    radius, edge = 6778137.0, 6378137.0 - 7e3
    sine = edge / radius
    cosine = np.sqrt(1.0 - sine**2)
    return radius * (sine * across - cosine * sun), 7668.0 * (cosine * across + sine * sun)


def loads(t, instant, r, v, rotation, dipole, force, torque):
    """Return force and torque, and the torque that no input commands; Sun and pole are those of a time ``instant``."""
    sun, pole = celestial.sun(EPOCH + instant), celestial.earth_pole(EPOCH + instant)
    fixed = celestial.earth_fixed(EPOCH + t, pole, TT_MINUS_UT1)
    rho = DENSITY_FACTOR * surroundings.density(r, sun, BULGE, surroundings.height(fixed @ r))
    wind = rotation.T @ (v - surroundings.air_velocity(r, pole[2]))
    away = sun - r
    distance, visible = np.linalg.norm(away), surroundings.light(r, sun)
    e = rotation.T @ away / distance
    air, light = surroundings.drag(PLATES, rho, wind), surroundings.sunlight(PLATES, visible, distance, e)
    pressure = surroundings.PRESSURE * (surroundings.UNIT / distance) ** 2 * visible
    sphere = -0.5 * rho * SPHERE_DRAG * SPHERE_AREA * np.linalg.norm(wind) * wind
    sphere = sphere - pressure * SPHERE_REFLECTIVITY * SPHERE_AREA * e
    field = rotation.T @ fixed.T @ harmonics.magnetic_field(fixed @ r, EPOCH, MAGNETIC_DEGREE)
    down = rotation.T @ r / np.linalg.norm(r)
    gradient = 3.0 * harmonics.EARTH_PARAMETER / np.linalg.norm(r) ** 3 * np.cross(down, INERTIA @ down)
    disturbance = air[1] + light[1] + gradient + np.cross(RESIDUAL, field)
    whole = disturbance + np.cross(dipole, field) + torque + np.cross(POINT, force)
    return air[0] + light[0] + sphere + force, whole, disturbance


def slope_of(motors, dipole, force, torque, external):
    """Return y' as a function of time and y = (r, v, q, w, wheel speeds, eta, eta') under inputs."""
    # unknown accelerations: of the body, of the wheels, of the modes
    matrix = np.block(
        [
            [INERTIA, SPIN * AXES.T, D],
            [SPIN * AXES, SPIN * np.eye(4), np.zeros((4, W.size))],
            [D.T, np.zeros((W.size, 4)), np.eye(W.size) - L.T @ L / MASS],
        ]
    )

    def slope(t, y):
        r, v, q, w, speeds, eta, rate = np.split(y, [3, 6, 10, 13, 17, 17 + W.size])
        rotation = matrix_of(q)
        acting, turn, _ = loads(t, t, r, v, rotation, dipole, force, torque)
        fixed = celestial.earth_fixed(EPOCH + t, celestial.earth_pole(EPOCH + t), TT_MINUS_UT1)
        fall = fixed.T @ harmonics.earth_gravity(fixed @ r, GRAVITY_DEGREE) + external
        fall = fall + celestial.tide(r, celestial.sun(EPOCH + t), celestial.SUN_PARAMETER)
        fall = fall + celestial.tide(r, celestial.moon(EPOCH + t), celestial.MOON_PARAMETER)
        momentum = INERTIA @ w + SPIN * speeds @ AXES + D @ rate
        friction = VISCOUS * speeds + COULOMB * np.clip(speeds / BAND, -1.0, 1.0)
        modal = -L.T @ acting / MASS - 2.0 * DAMPING[MODES] * W * rate - W**2 * eta
        right = np.concatenate(
            [turn - np.cross(L @ eta / MASS, acting) - np.cross(w, momentum), motors - friction, modal]
        )
        accelerations = np.linalg.solve(matrix, right)
        q_rate = 0.5 * np.array([-q[1:] @ w, *(q[0] * w + np.cross(q[1:], w))])
        return np.concatenate(
            [v, fall + rotation @ acting / MASS, q_rate, accelerations[:3], accelerations[3:7], rate, accelerations[7:]]
        )

    return slope


def spacecraft():
    """Check all effects at once, in the half-shadow: two modes among four, wheels within their
    band of friction and not."""
    random = np.random.default_rng(57)
    change = lambda size, scale: np.repeat(random.uniform(-scale, scale, (5, size)), 8, axis=0)[:ROWS]  # noqa: E731
    commands, dipole, force = change(4, 8e-3), change(3, 5.0), change(3, 0.02)
    torque, external = change(3, 1e-3), change(3, 1e-4)
    commands[:8] *= 0.3
    dipole[:16] *= 0.5
    beyond = (np.abs(commands) > TORQUE_LIMIT).any(axis=1)
    clipped = (np.abs(dipole) > DIPOLE_LIMIT).any(axis=1)
    assert beyond[8:16].any()
    assert clipped[16:].any()
    assert not clipped[:16].any()
    motors, applied = (
        FACTOR * np.clip(commands, -TORQUE_LIMIT, TORQUE_LIMIT),
        np.clip(dipole, -DIPOLE_LIMIT, DIPOLE_LIMIT),
    )
    r, v = start_of_flight()
    q, w, speeds = unit([0.5, 0.1, -0.7, 0.5]), np.array([0.03, -0.02, 0.04]), np.array([2.0, -190.0, 220.0, -160.0])
    start = np.concatenate([r, v, q, w, speeds, np.zeros(2 * W.size)])
    y = fly(
        lambda row: slope_of(motors[row], applied[row], force[row], torque[row], external[row]), start, ROWS, atol=1e-13
    )
    r, v, q, w, speeds, eta, rate = np.split(y, [3, 6, 10, 13, 17, 17 + W.size], axis=1)
    assert (np.abs(speeds[:, 0]) < BAND).all()
    assert (np.abs(speeds[:, 1:]) > BAND).all()
    forces, disturbances = [], []
    for n in range(ROWS):
        t, instant = STEP * n, max(STEP * n - 0.5 * INTERNAL, 0.0)
        inputs = max(n - 1, 0)
        acting, _, disturbance = loads(
            t, instant, r[n], v[n], matrix_of(q[n]), applied[inputs], force[inputs], torque[inputs]
        )
        forces.append(acting / MASS)
        disturbances.append(disturbance)
    light = [surroundings.light(r[n], celestial.sun(EPOCH + STEP * n)) for n in (0, -1)]
    assert 0.0 < light[0] < light[1] < 1.0
    momentum = w @ INERTIA + SPIN * speeds @ AXES + rate @ D.T
    displacements = np.zeros((ROWS, 4))
    displacements[:, MODES] = eta
    return Check(
        truth="accelerations from the equations of motion by DOP853 at 1e-13, the surroundings from published series",
        step=STEP,
        inputs={
            "motor_torques": commands,
            "dipole": dipole,
            "body_force": force,
            "body_torque": torque,
            "external_acceleration": external,
        },
        outputs={
            "position": r,
            "velocity": v,
            "quaternion": q,
            "angular_velocity": w,
            "wheel_speeds": speeds,
            "wheel_momentum": SPIN * speeds @ AXES,
            "applied_torques": np.vstack([np.zeros(4), motors[:-1]]),
            "mode_displacements": displacements,
            "angular_momentum": np.array([matrix_of(q[n]) @ momentum[n] for n in range(ROWS)]),
            "specific_force": np.array(forces),
            "applied_dipole": follow(applied),
            "disturbance_torque": np.array(disturbances),
            "status": follow(np.where(clipped, 3, beyond)) * (np.arange(ROWS) > 0),
        },
        tolerances={
            "position": (1e-7, 0.0),
            "velocity": (1e-10, 0.0),
            "quaternion": (1e-11, 0.0),
            "angular_velocity": (3e-11, 0.0),
            "wheel_speeds": (1e-10, 0.0),
            "wheel_momentum": (1e-13, 0.0),
            "applied_torques": (1e-15, 0.0),
            "mode_displacements": (1e-10, 0.0),
            "angular_momentum": (1e-12, 0.0),
            "specific_force": (1e-15, 0.0),
            "applied_dipole": (1e-15, 0.0),
            "disturbance_torque": (5e-15, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "epoch": EPOCH,
            "tt_minus_ut1": TT_MINUS_UT1,
            "gravity_degree": np.array(GRAVITY_DEGREE),
            "density_factor": DENSITY_FACTOR,
            "bulge_exponent": BULGE,
            "magnetic_degree": np.array(MAGNETIC_DEGREE),
            "plates": PLATES,
            "sphere_area": SPHERE_AREA,
            "sphere_drag": SPHERE_DRAG,
            "sphere_reflectivity": SPHERE_REFLECTIVITY,
            "residual_dipole": RESIDUAL,
            "dipole_limit": DIPOLE_LIMIT,
            "force_point": POINT,
            "mass": MASS,
            "inertia": INERTIA,
            "wheel_axes": AXES,
            "wheel_inertia": SPIN,
            "motor_torque_limit": TORQUE_LIMIT,
            "torque_factor": FACTOR,
            "viscous_friction": VISCOUS,
            "coulomb_friction": COULOMB,
            "coulomb_band": BAND,
            "mode_frequency": FREQUENCY,
            "mode_damping": DAMPING,
            "mode_translation": TRANSLATION,
            "mode_rotation": ROTATION,
            "initial_position": y[0, :3],
            "initial_velocity": y[0, 3:6],
            "initial_quaternion": q[0],
            "initial_angular_velocity": w[0],
            "initial_wheel_speeds": speeds[0],
            "internal_step": INTERNAL,
        },
    )


TRUTHS = {"spacecraft": spacecraft}
