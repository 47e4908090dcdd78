"""Complete control loop of the rendezvous in plain Python, over a short approach: signs, sampling, connections.

Truth: the plan, which the true motion must follow within a few of the sensors' sigmas, and conservation of momentum.
The numbers of the complete flight are tested with the system (docs/systems/robot_rendezvous.md).
"""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.fmus_src.actuators.gyro_steering_explicit import GyroSteeringExplicit
from perilune.fmus_src.actuators.jet_allocation_pseudo_inverse import JetAllocationPseudoInverse
from perilune.fmus_src.control.attitude_control import AttitudeControl
from perilune.fmus_src.control.translation_control import TranslationControl
from perilune.fmus_src.guidance.rendezvous_guidance import RendezvousGuidance
from perilune.fmus_src.navigation.attitude_filter import AttitudeFilter
from perilune.fmus_src.navigation.rendezvous_monitor import RendezvousMonitor
from perilune.fmus_src.navigation.translation_filter import TranslationFilter
from perilune.fmus_src.plants.drifting_target import DriftingTarget
from perilune.fmus_src.plants.free_flying_robot import FreeFlyingRobot
from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.sensors.laser_ranger import LaserRanger
from perilune.fmus_src.sensors.star_inertial import StarInertial

ARCSEC = np.pi / 180.0 / 3600.0
H = 0.125
SPIN = np.array([-0.608, 0.228, 0.760]) / np.linalg.norm([-0.608, 0.228, 0.760])
DRIFT = np.array([-0.005, 0.004, 0.006])
TIMES = {"turn_start": 60.0, "turn_end": 160.0, "arrival_time": 280.0}
TARGET = np.array([3.0, 2.0, -1.5]) + 30.0 * SPIN - 280.0 * DRIFT
SOURCES = {"robot": FreeFlyingRobot, "target": DriftingTarget, "guidance": RendezvousGuidance}
FOLLOWERS = {
    "star": StarInertial,
    "ranger": LaserRanger,
    "attitude_filter": AttitudeFilter,
    "translation_filter": TranslationFilter,
    "translation_control": TranslationControl,
    "jets": JetAllocationPseudoInverse,
    "attitude_control": AttitudeControl,
    "gyros": GyroSteeringExplicit,
    "monitor": RendezvousMonitor,
}
INTO = {
    "robot": {"jet_thrust": "jets", "gimbal_rates": "gyros"},
    "star": {"quaternion": "robot"},
    "ranger": {"robot_position": "robot.position", "target_position": "target.position"},
    "attitude_filter": {
        "measured_quaternion": "star",
        "sample_count": "star",
        "planned_quaternion": "guidance",
        "planned_angular_velocity": "guidance",
        "gyro_momentum": "robot",
        "jet_torque": "jets.allocated_torque",
        "jet_force": "jets.allocated_force",
    },
    "translation_filter": {
        "relative_position": "ranger",
        "sample_count": "ranger",
        "planned_relative_position": "guidance",
        "planned_velocity": "guidance",
        "translation_count": "guidance",
        "quaternion": "attitude_filter",
        "allocated_force": "jets",
    },
    "translation_control": {
        "position_error": "translation_filter",
        "velocity_error": "translation_filter",
        "planned_acceleration": "guidance",
        "translation_period": "guidance",
        "translation_count": "guidance",
    },
    "jets": {
        "force_command": "translation_control",
        "command_count": "translation_control",
        "quaternion": "attitude_filter",
        "translation_period": "guidance",
    },
    "attitude_control": {
        "attitude_error": "attitude_filter",
        "rate_error": "attitude_filter",
        "disturbance": "attitude_filter",
        "planned_angular_velocity": "guidance",
        "planned_angular_acceleration": "guidance",
        "gyro_momentum": "robot",
        "jet_torque": "jets.allocated_torque",
    },
    "gyros": {"torque_command": "attitude_control", "gimbal_angles": "robot"},
    "monitor": {
        "robot_position": "robot.position",
        "target_position": "target.position",
        "quaternion": "robot",
        "planned_relative_position": "guidance",
        "planned_quaternion": "guidance",
    },
}


class Loop:
    """All blocks with their connections, stepped as the co-simulation does."""

    def __init__(self, **parameters):
        self.components = {name: BlockInstance(block) for name, block in (SOURCES | FOLLOWERS).items()}
        self.blocks = {name: component.block for name, component in self.components.items()}
        values = {"target.initial_position": TARGET.tolist(), "target.constant_velocity": DRIFT.tolist()}
        values |= {"guidance.target_position": TARGET.tolist(), "guidance.target_velocity": DRIFT.tolist()}
        values |= {f"guidance.{name}": value for name, value in TIMES.items()} | {"gyros.torque_lead": 0.125}
        for place, value in (values | parameters).items():
            name, variable = place.split(".")
            setattr(self.blocks[name], variable, value)
        for name, component in self.components.items():
            self.read_inputs(name)
            component.start()
        self.time = 0.0

    def read_inputs(self, name):
        for variable, source in INTO.get(name, {}).items():
            block, _, output = source.partition(".")
            value = getattr(self.blocks[block], output or variable)
            setattr(self.blocks[name], variable, value)

    def step(self, h):
        """Step sources with the inputs of now, then the others in order; values from later ones are a step late."""
        for name in SOURCES:
            self.read_inputs(name)
        for name in SOURCES:
            self.components[name].do_step(self.time, h)
        for name in FOLLOWERS:
            self.read_inputs(name)
            self.components[name].do_step(self.time, h)
        self.time += h

    def fly(self, end, h=H):
        """Return rows of time, position error and attitude error."""
        rows = []
        while self.time < end:
            self.step(h)
            monitor = self.blocks["monitor"]
            rows.append([self.time, *monitor.position_error, *monitor.attitude_error])
        return np.array(rows)


MEAN_AND_LEAD = {
    "translation_filter.method": 0,
    "attitude_filter.method": 0,
    "translation_control.law": 0,
    "attitude_control.law": 0,
}


@pytest.mark.parametrize(
    ("parameters", "position", "rms", "turn"),
    [(MEAN_AND_LEAD, 0.03, 0.5, 2.0), ({"translation_filter.first_velocity_sigma": 0.001}, 0.015, 0.3, 1.5)],
    ids=["mean and lead", "Kalman"],
)
def test_plan_is_followed(parameters, position, rms, turn):
    loop = Loop(**parameters)
    rows = loop.fly(320.0)
    time, places, angles = rows[:, 0], rows[:, 1:4], rows[:, 4:] / ARCSEC
    late = time > 240.0
    assert abs(places[late]).max() < position
    assert np.sqrt((angles[late] ** 2).mean(axis=0)).max() < rms
    assert abs(angles[(time > 60.0) & (time < 160.0)]).max() < turn
    camera = Rotation.from_quat(loop.blocks["robot"].quaternion, scalar_first=True).apply([1.0, 0.0, 0.0])
    assert camera == pytest.approx(SPIN, abs=1e-5)
    assert loop.blocks["monitor"].range == pytest.approx(30.0, abs=position)
    # jets without torque: the body and its gyros keep the momentum that they had
    momentum = np.array([812.0, 587.0, 910.0]) * loop.blocks["robot"].angular_velocity
    assert momentum + loop.blocks["robot"].gyro_momentum == pytest.approx(np.zeros(3), abs=1e-3)
    assert all(loop.blocks[name].status == 0 for name in ("guidance", "jets", "gyros", "attitude_control"))


def test_results_do_not_depend_on_communication_steps():
    coarse, fine = Loop(), Loop()
    for _ in range(300):
        coarse.step(H)
        fine.step(0.5 * H)
        fine.step(0.5 * H)
    for name in coarse.blocks:
        first, second = (vars(loop.blocks[name]) for loop in (coarse, fine))
        assert first == second, name
