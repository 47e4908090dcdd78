"""Ports of a satellite with four reaction wheels: wheels and reference attitude."""

from ...bundles import Bundle
from ...ports import Port
from . import body

DIAGONAL = 0.5773502691896258  # 1/sqrt(3)

BIAS = Port([0.0, 0.0, 0.0], unit="rad/s", frame="body", description="gyro bias")
GYRO_RANDOM_WALK = Port(
    3.1622776601683795e-7, minimum=0.0, description="angle random walk of the gyros, rad per square root of s"
)
BIAS_RANDOM_WALK = Port(
    3.1622776601683795e-10, minimum=0.0, description="rate random walk of the gyro bias, rad/s per square root of s"
)
MOTOR_TORQUES = Port(
    [0.0] * 4, unit="N.m", description="commanded torque of each motor on its wheel about the spin axis"
)
MOTOR_TORQUE_LIMIT = Port(0.2, unit="N.m", minimum=0.0, description="largest magnitude of a wheel motor's torque")
# the diagonals of a cube's upper half: a pyramid about z, with equal torque capability about x, y and z
WHEEL_AXES = Port(
    [*[DIAGONAL] * 3, -DIAGONAL, *[DIAGONAL] * 2, *[-DIAGONAL] * 2, *[DIAGONAL] * 2, -DIAGONAL, DIAGONAL],
    unit="1",
    frame="body",
    columns=3,
    description="spin axes of the wheels in body axes, one per row, of any length",
)
WHEEL_INERTIA = Port(
    0.03, unit="kg.m2", minimum=1e-9, description="moment of inertia of each wheel about its spin axis"
)
WHEEL_SPEEDS = Port(
    [0.0] * 4, unit="rad/s", description="angular rates of the wheels relative to the body about their spin axes"
)


class AttitudeReference(Bundle):
    """Reference attitude with angular velocity and acceleration."""

    reference_quaternion = Port(
        [1.0, 0.0, 0.0, 0.0], unit="1", description="reference attitude quaternion from body to inertial, scalar first"
    )
    reference_angular_velocity = Port(
        [0.0, 0.0, 0.0],
        unit="rad/s",
        frame="reference body",
        description="angular velocity of the reference attitude relative to the inertial frame",
    )
    reference_angular_acceleration = Port(
        [0.0, 0.0, 0.0],
        unit="rad/s2",
        frame="reference body",
        description="angular acceleration of the reference attitude, mean until the next sample",
    )


INERTIA = Port(
    [180.0, -4.0, 2.0, -4.0, 150.0, 3.0, 2.0, 3.0, 120.0],
    unit="kg.m2",
    frame="body",
    columns=3,
    description="inertia matrix of the satellite about its centre of mass, wheels included as if not spinning",
)
WHEEL_MOMENTUM = body.ANGULAR_MOMENTUM  # sum of Js W g over the wheels, relative to the body
