"""Independent simulation of attitude on a circular orbit by numpy, with direction cosines in inertial axes.

It is written from Euler's equations and the gravity gradient of a rigid body (Hughes 1986, sections 3.1 and 8.1).
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

ORBITAL_RATE = 0.0011
INERTIA = np.array([[6500.0, -150.0, -100.0], [-150.0, 30000.0, -200.0], [-100.0, -200.0, 29000.0]])
JET_TORQUE = np.array([60.0, 120.0, 120.0])
DEGREE = np.pi / 180.0


def body_from_orbital(angles):
    """Return direction cosines of (roll, yaw, pitch): yaw about y, then pitch about z, then roll about x."""
    roll, yaw, pitch = angles
    return Rotation.from_euler("YZX", [yaw, pitch, roll]).as_matrix().T


def angles_of(matrix):
    """Return (roll, yaw, pitch) of the direction cosines from the orbital frame to the body."""
    yaw, pitch, roll = Rotation.from_matrix(matrix.T).as_euler("YZX")
    return np.array([roll, yaw, pitch])


def orbital_from_inertial(time):
    """Return the rotation of the orbital frame by -w0 t about its z axis; inertial axes are those of the start."""
    return Rotation.from_rotvec([0.0, 0.0, -ORBITAL_RATE * time]).as_matrix().T


def acceleration(matrix, w, torque, inertia=INERTIA):
    """Return w' (body) for direction cosines from orbital to body."""
    up = matrix[:, 1]
    moment = 3.0 * ORBITAL_RATE**2 * np.cross(up, inertia @ up) - np.cross(w, inertia @ w) + torque
    return np.linalg.solve(inertia, moment)


def turn(axis, angle):
    """Return the matrix of a turn about a coordinate axis; angles may be complex."""
    return expm(angle * np.cross(np.eye(3), np.eye(3)[axis]))


def rates_of(state, torque=(0.0, 0.0, 0.0), inertia=INERTIA):
    """Return (angles, w)' of (angles, w), which may be complex: rates follow from the turns' axes in the body."""
    roll, yaw, pitch = state[:3]
    by_roll, by_pitch = turn(0, roll).T, turn(2, pitch).T
    from_orbital = by_roll @ by_pitch @ turn(1, yaw).T
    axes = np.column_stack([np.eye(3)[0], by_roll @ by_pitch[:, 1], by_roll[:, 2]])
    w = state[3:]
    angle_rates = np.linalg.solve(axes, w + ORBITAL_RATE * from_orbital[:, 2])
    return np.concatenate([angle_rates, acceleration(from_orbital, w, np.array(torque), inertia)])


def derivatives_of(function, state):
    """Return matrix of the derivatives of a function by a state, by complex steps."""
    return np.column_stack([function(state + 1e-30j * unit).imag / 1e-30 for unit in np.eye(len(state))])


def flown(angles, w, times, torque_at, cuts=(), inertia=INERTIA):
    """Integrate (angles, w) to the times by DOP853 at 1e-13 in inertial axes, from cut to cut of the torque."""
    state = np.concatenate([(body_from_orbital(angles) @ orbital_from_inertial(0.0)).ravel(), w])

    def slopes(time, state, torque):
        from_inertial, w = state[:9].reshape(3, 3), state[9:]
        skew = np.array([[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]])
        from_orbital = from_inertial @ orbital_from_inertial(time).T
        return np.concatenate([(-skew @ from_inertial).ravel(), acceleration(from_orbital, w, torque, inertia)])

    rows, edges = {}, sorted({0.0, *times, *cuts})
    for start, end in zip([0.0, *edges], edges, strict=False):
        if end > start:
            torque = torque_at(0.5 * (start + end))
            state = solve_ivp(slopes, (start, end), state, "DOP853", args=(torque,), rtol=1e-13, atol=1e-15).y[:, -1]
        rows[end] = (angles_of(state[:9].reshape(3, 3) @ orbital_from_inertial(end).T), state[9:])
    return np.array([rows[time][0] for time in times]), np.array([rows[time][1] for time in times])
