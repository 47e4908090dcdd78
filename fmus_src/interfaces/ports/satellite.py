"""A satellite with four reaction wheels: its wheels, and the attitude that it is to follow."""

from ...bundles import Bundle
from ...ports import Port
from . import body, robot

DIAGONAL = 0.5773502691896258  # 1/sqrt(3)

BIAS = Port([0.0, 0.0, 0.0], unit="rad/s", frame="body", description="bias of the gyros")
GYRO_RANDOM_WALK = Port(3.1622776601683795e-7, minimum=0.0, description="angle random walk, rad per square root of s")
BIAS_RANDOM_WALK = Port(3.1622776601683795e-10, minimum=0.0, description="random walk of the bias, rad/s per root of s")
MOTOR_TORQUES = Port([0.0] * 4, unit="N.m", description="torque of each motor on its wheel")
MOTOR_TORQUE_LIMIT = Port(0.2, unit="N.m", minimum=0.0, description="largest torque of a motor, both ways")
# the diagonals of a cube's upper half: a pyramid about z, alike for torques about x, y and z
WHEEL_AXES = Port(
    [*[DIAGONAL] * 3, -DIAGONAL, *[DIAGONAL] * 2, *[-DIAGONAL] * 2, *[DIAGONAL] * 2, -DIAGONAL, DIAGONAL],
    unit="1",
    frame="body",
    columns=3,
    description="spin axes of the wheels, by row, of any length",
)
WHEEL_INERTIA = Port(0.03, unit="kg.m2", minimum=1e-9, description="of a wheel about its spin axis")
WHEEL_SPEEDS = Port([0.0] * 4, unit="rad/s", description="speeds of the wheels relative to the body")


class AttitudeReference(Bundle):
    """The attitude to follow."""

    reference_quaternion = robot.PLANNED_QUATERNION
    reference_angular_velocity = Port(
        [0.0, 0.0, 0.0], unit="rad/s", frame="body of the reference", description="angular velocity to be at now"
    )
    reference_angular_acceleration = Port(
        [0.0, 0.0, 0.0],
        unit="rad/s2",
        frame="body of the reference",
        description="mean angular acceleration until the next sample",
    )


INERTIA = Port(
    [180.0, -4.0, 2.0, -4.0, 150.0, 3.0, 2.0, 3.0, 120.0],
    unit="kg.m2",
    frame="body",
    columns=3,
    description="matrix of inertia of the satellite with its wheels, as if they did not spin",
)
WHEEL_MOMENTUM = body.ANGULAR_MOMENTUM  # of the wheels relative to the body, Js W g summed
