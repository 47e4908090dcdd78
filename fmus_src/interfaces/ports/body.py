"""Ports in body axes, and ports of a spacecraft on a circular orbit."""

from ...ports import Port

ANGLES = Port([0.0, 0.0, 0.0], unit="rad", description="roll, yaw and pitch of the body relative to the orbital frame")
ANGULAR_ACCELERATION = Port(
    [0.0, 0.0, 0.0],
    unit="rad/s2",
    frame="body",
    description="angular acceleration of the body relative to the inertial frame",
)
ANGULAR_MOMENTUM = Port(
    [0.0, 0.0, 0.0], unit="N.m.s", frame="body", description="angular momentum about the centre of mass"
)
ANGULAR_VELOCITY = Port(
    [0.0, 0.0, 0.0],
    unit="rad/s",
    frame="body",
    description="angular velocity of the body relative to the inertial frame",
)
ESTIMATED_ANGLES = Port(
    [0.0, 0.0, 0.0], unit="rad", description="estimated roll, yaw and pitch of the body relative to the orbital frame"
)
FORCE = Port([0.0, 0.0, 0.0], unit="N", frame="body", description="force on the body")
INERTIA = Port(
    [1400.0, -40.0, 0.0, -40.0, 1250.0, 0.0, 0.0, 0.0, 1200.0],
    unit="kg.m2",
    frame="body",
    columns=3,
    description="inertia matrix about the centre of mass",
)
JET_TORQUE = Port(
    [60.0, 120.0, 120.0],
    unit="N.m",
    frame="body",
    minimum=1e-9,
    description="torque of one jet about x, y and z, equal for both signs",
)
MEASURED_PITCH = Port(0.0, unit="rad", description="measured pitch of the body relative to the orbital frame")
MEASURED_ROLL = Port(0.0, unit="rad", description="measured roll of the body relative to the orbital frame")
PULSES = Port(
    [0.0, 0.0, 0.0],
    unit="s",
    frame="body",
    description="commanded pulse lengths of the jets about x, y and z, signed as the torque",
)
PULSE_COUNT = Port(0, description="number of pulse commands since the start; a change signals new pulses")
ROTATION = Port([0.0, 0.0, 0.0], unit="rad", frame="body", description="rotation vector")
SHORTEST_PULSE = Port(0.03, unit="s", minimum=0.0, description="shortest pulse that a jet can fire")
TORQUE = Port([0.0, 0.0, 0.0], unit="N.m", frame="body", description="torque on the body")
