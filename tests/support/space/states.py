"""Initial states of a spacecraft, shared by several tests."""

import numpy as np

QUIET = {"atmosphere": 0, "residual_dipole": [0.0, 0.0, 0.0]}  # gravity alone
# So far away that nothing of gravity reaches the last bit of an angular momentum.
FAR = QUIET | {
    "initial_position": [1e15, 0.0, 0.0],
    "initial_velocity": [0.0, 0.0, 0.0],
    "third_bodies": False,
    "gravity_degree": 0,
}
FRICTIONLESS = {"viscous_friction": 0.0, "coulomb_friction": 0.0}
WHEELS = {"wheel_inertia": 0.02, "motor_torque_limit": 1.0, "speed_limit": 0.0}
MASS, INERTIA = 800.0, np.array([[180.0, -4.0, 2.0], [-4.0, 150.0, 3.0], [2.0, 3.0, 120.0]])
ALONG = np.array([[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]])  # lines along which two particles move
TRANSLATION = np.sqrt([[20.0], [15.0]]) * ALONG  # of 20 and 15 kg
ROTATION = np.sqrt([[20.0], [15.0]]) * np.cross([[0.5, 0.3, 1.0], [-0.2, 0.4, -0.6]], ALONG)
FREQUENCY = np.array([0.9, 1.7])
PARTICLES = {
    "mass": MASS,
    "inertia": INERTIA,
    "mode_frequency": [*FREQUENCY, 0.0, 0.0],
    "mode_damping": [0.01, 0.02, 0.0, 0.0],
    "mode_translation": np.vstack([TRANSLATION, np.zeros((2, 3))]),
    "mode_rotation": np.vstack([ROTATION, np.zeros((2, 3))]),
}
UNDAMPED = PARTICLES | {"mode_damping": [0.0] * 4}
