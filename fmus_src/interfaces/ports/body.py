"""Vectors of body axes, and what turns a spacecraft on a circular orbit."""

from ...ports import Port

ANGLES = Port([0.0, 0.0, 0.0], unit="rad", description="roll, yaw and pitch of the body relative to the orbital frame")
ANGULAR_ACCELERATION = Port([0.0, 0.0, 0.0], unit="rad/s2", frame="body", description="angular acceleration")
ANGULAR_MOMENTUM = Port([0.0, 0.0, 0.0], unit="N.m.s", frame="body", description="angular momentum")
ANGULAR_VELOCITY = Port(
    [0.0, 0.0, 0.0], unit="rad/s", frame="body", description="angular velocity relative to the inertial frame"
)
ESTIMATED_ANGLES = Port([0.0, 0.0, 0.0], unit="rad", description="estimated roll, yaw and pitch")
FORCE = Port([0.0, 0.0, 0.0], unit="N", frame="body", description="force")
INERTIA = Port(
    [1400.0, -40.0, 0.0, -40.0, 1250.0, 0.0, 0.0, 0.0, 1200.0],
    unit="kg.m2",
    frame="body",
    columns=3,
    description="inertia matrix",
)
JET_TORQUE = Port(
    [60.0, 120.0, 120.0],
    unit="N.m",
    frame="body",
    minimum=1e-9,
    description="torque of a jet about x, y, z, both signs",
)
MEASURED_PITCH = Port(0.0, unit="rad", description="measured pitch")
MEASURED_ROLL = Port(0.0, unit="rad", description="measured roll")
PULSES = Port([0.0, 0.0, 0.0], unit="s", frame="body", description="signed pulse lengths about x, y, z")
PULSE_COUNT = Port(0, description="number of pulse commands so far; a change signals new pulses")
ROTATION = Port([0.0, 0.0, 0.0], unit="rad", frame="body", description="rotation vector")
SHORTEST_PULSE = Port(0.03, unit="s", minimum=0.0, description="shortest pulse length")
TORQUE = Port([0.0, 0.0, 0.0], unit="N.m", frame="body", description="torque")
