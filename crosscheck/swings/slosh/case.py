"""Two particles on springs, as propellant in two tanks, in a craft under a force and a torque."""

import numpy as np

from crosscheck.swing import Swing

MASS, INERTIA = 800.0, ((180.0, -4.0, 2.0), (-4.0, 150.0, 3.0), (2.0, 3.0, 120.0))  # kg, kg m2, of the whole
PARTICLES = np.array([20.0, 15.0])  # kg
POSITIONS = np.array([[0.5, 0.3, 1.0], [-0.2, 0.4, -0.6]])  # m, at rest
ALONG = np.array([[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]])  # unit vectors along which they move
FREQUENCY, DAMPING = np.array([0.9, 1.7]), np.array([0.01, 0.02])  # rad/s, on a fixed base
FORCE, TORQUE = np.array([0.3, -0.2, 0.15]), np.array([0.1, -0.08, 0.06])  # N, N m, body

CASE = Swing(
    title="two sloshing masses",
    verifies="modes of spacecraft as particles on springs, 35 of 800 kg",
    matched="`LinearSpringMassDamper`; force and torque at the undeformed centre of mass",
    step=1.0 / 64.0,
    duration=40.0,
    displacements=("displacement[1]", "displacement[2]"),
    fall=80.0,
    bound=1e-3,
)
