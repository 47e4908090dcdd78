"""A satellite is turned by four reaction wheels with friction, under a constant torque in body axes."""

from crosscheck.case import ATTITUDE, RATE, WHEEL_SPEED, Case

INERTIA = ((180.0, -4.0, 2.0), (-4.0, 150.0, 3.0), (2.0, 3.0, 120.0))  # kg m2, with the wheels
AXES = ((0.6, 0.5, 0.7), (-0.5, 0.6, 0.7), (-0.6, -0.5, 0.6), (0.5, -0.6, 0.7))  # spin axes, of any length
SPIN_INERTIA = 0.5  # kg m2, so that body and wheels act on each other strongly
VISCOUS, COULOMB = 1e-3, 5e-3  # N m s, N m
TORQUE = (2e-3, -1e-3, 3e-3)  # N m, external, body
QUATERNION, ANGULAR_VELOCITY = (0.5, 0.5, -0.1, 0.7), (0.02, -0.03, 0.01)  # body to inertial; rad/s, body
SPEEDS = (100.0, -80.0, 60.0, -120.0)  # rad/s, at the start: no wheel stops, where friction jumps
COMMANDS = (  # s, N m: when motor torques begin
    (0.0, (0.2, -0.1, 0.15, 0.05)),
    (100.0, (-0.1, 0.2, 0.3, -0.2)),
    (200.0, (0.0, -0.3, -0.1, 0.1)),
)

CASE = Case(
    title="four reaction wheels",
    verifies="wheel_satellite: body and wheels with viscous and Coulomb friction under motor torques, skewed axes",
    gravitation="none",
    environment="constant torque in body axes",
    integrator="Runge-Kutta of fourth order; quaternion, inertial angular momentum and absolute spins here, MRP, rate "
    "and relative speeds in Basilisk",
    matched="same start, same motor torques, changed between steps; in Basilisk `BalancedWheels`, whose hub inertia "
    "includes the wheels, as here; wheels far from rest and from their limits",
    step=0.25,
    duration=300.0,
    quantities={"attitude": ATTITUDE, "rate": RATE, "wheel speed": WHEEL_SPEED},
    bounds={"attitude": 1e-6, "rate": 5e-8, "wheel speed": 1e-7},
)
