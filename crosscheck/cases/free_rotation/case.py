"""Free rotation of a body with three different moments of inertia, about its unstable axis."""

from crosscheck.case import ATTITUDE, RATE, Case

INERTIA = (812.0, 587.0, 910.0)  # kg m2, principal
QUATERNION, ANGULAR_VELOCITY = (0.5, 0.5, -0.1, 0.7), (0.1, 2e-3, -2e-3)  # body to inertial; rad/s, body

CASE = Case(
    title="attitude kinematics",
    verifies="free_flying_robot without torque: Euler's equations and attitude, turning about the intermediate axis",
    gravitation="none",
    environment="none",
    integrator="Runge-Kutta of fourth order; quaternion and inertial angular momentum here, MRP and rate in Basilisk",
    matched="same start; difference of attitudes: the angle of the turn between them",
    step=0.125,
    duration=600.0,
    quantities={"attitude": ATTITUDE, "rate": RATE},
    bounds={"attitude": 3e-8, "rate": 3e-9},
)
