"""Two hinged panels on a craft under a force and a torque."""

import numpy as np

from crosscheck.swing import Swing

MASS, INERTIA = 800.0, ((400.0, -4.0, 2.0), (-4.0, 250.0, 3.0), (2.0, 3.0, 420.0))  # kg, kg m2, of the whole
PANEL, ARM = 10.0, 1.5  # kg; m, from the hinge to the panel's centre of mass
PANEL_INERTIA = np.diag([7.5, 0.9, 8.4])  # kg m2, of a panel about its centre of mass, body
HINGES = np.array([[0.1, 0.6, 0.05], [0.1, -0.6, 0.05]])  # m
OUTWARDS = np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]])  # from the hinge to the centre of mass
AXIS = np.array([1.0, 0.0, 0.0])  # of both hinges
CENTRES = HINGES + ARM * OUTWARDS  # m
FREQUENCY, DAMPING = np.array([1.0, 1.3]), np.array([0.005, 0.01])  # rad/s, on a fixed base
FORCE, TORQUE = np.array([0.3, -0.2, 0.5]), np.array([0.2, -0.08, 0.06])  # N, N m, body
ABOUT_HINGE = float(AXIS @ PANEL_INERTIA @ AXIS + PANEL * ARM**2)  # kg m2

CASE = Swing(
    title="two hinged panels",
    verifies="modes of spacecraft as hinged panels, a quarter of the inertia about an axis",
    matched="`HingedRigidBodyStateEffector`; force and torque at the undeformed centre of mass",
    step=1.0 / 64.0,
    duration=40.0,
    displacements=("displacement[1]", "displacement[2]"),
    fall=80.0,
    bound=1e-3,
)
