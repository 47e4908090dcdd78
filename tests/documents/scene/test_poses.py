"""Position and rotation of a body in a scene, in every form of declaration.

Truth: scipy's Rotation, the matrices of docs/systems/orbital_attitude.md and entry_attitude.md, Cartesian coordinates
of points on a sphere, the theorem of Gauss and Bonnet, and the direction of motion.
"""

from itertools import pairwise, product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.analysis.documents.figures.scene.scene_elements import (
    Angles,
    Geographic,
    Quaternion,
    ThrustAxis,
    WindAngles,
)
from perilune.analysis.documents.scene.poses import compute_poses
from perilune.fmus_src.mathlib.entry.motion import body_axes
from perilune.fmus_src.mathlib.vectors import vector as kernel_vector
from tests.support.scenes.made import METRE, angle, body, cartesian, flown, scalar, scene, sphere, vector

ROWS = 10
EXACT = 1e-6
RADIUS = 6371000.0
RANDOM = np.random.default_rng(12)


def pose(signals, declared, surface=None):
    """Return position, [3, n], and rotations of the only body, as scipy has them, of what the page stores in
    float32."""
    (computed,) = compute_poses(scene(declared, surface=surface), flown(**signals))
    stored = computed.attitude.astype(np.float32).astype(float)
    assert np.allclose(np.linalg.norm(stored, axis=0), 1.0, atol=EXACT)
    return computed.position, Rotation.from_quat(stored.T, scalar_first=True)


def assert_axes(rotation, expected):
    """Assert the axes of the body in the scene's frame."""
    assert np.abs(rotation.as_matrix() - expected.as_matrix()).max() < EXACT


def test_quaternions_of_any_length():
    quaternions = RANDOM.normal(size=(4, ROWS)) * 3.0
    _, rotation = pose({"attitude": quaternions}, body(attitude=Quaternion(vector("ship.attitude", 4))))
    assert_axes(rotation, Rotation.from_quat(quaternions.T, scalar_first=True))


def test_quaternions_do_not_change_sign():
    turning = Rotation.from_rotvec(np.outer(np.linspace(0.0, 20.0, 60), [0.0, 0.6, 0.8])).as_quat(scalar_first=True)
    signs = RANDOM.choice([-1.0, 1.0], size=60)
    (computed,) = compute_poses(
        scene(body(attitude=Quaternion(vector("ship.attitude", 4)))), flown(attitude=(turning * signs[:, None]).T)
    )
    assert (np.sum(computed.attitude[:, 1:] * computed.attitude[:, :-1], axis=0) > 0.9).all()


SEQUENCES = [
    "".join(axes)
    for size in (1, 2, 3)
    for axes in product("xyz", repeat=size)
    if all(first != second for first, second in pairwise(axes))
]


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_angles_of_every_sequence(sequence):
    angles = RANDOM.uniform(-4.0, 4.0, size=(len(sequence), ROWS))
    signals = {f"angle{index}": row for index, row in enumerate(angles)}
    declared = body(attitude=Angles(tuple(angle(name) for name in signals), sequence))
    _, rotation = pose(signals, declared)
    assert_axes(rotation, Rotation.from_euler(sequence.upper(), angles.T))


def test_angles_of_a_spacecraft_on_an_orbit():
    """D of the page on orbital_attitude leads from the orbital frame to the body: its rows are the body's axes."""
    roll, yaw, pitch = RANDOM.uniform(-1.0, 1.0, size=(3, ROWS))
    declared = body(attitude=Angles((angle("yaw"), angle("pitch"), angle("roll")), "yzx"))
    _, rotation = pose({"roll": roll, "yaw": yaw, "pitch": pitch}, declared)
    (sg, cg), (sy, cy), (st_, ct) = ((np.sin(each), np.cos(each)) for each in (roll, yaw, pitch))
    to_body = np.array(
        [
            [cy * ct, st_, -sy * ct],
            [sg * sy - cg * cy * st_, cg * ct, sg * cy + cg * sy * st_],
            [cg * sy + sg * cy * st_, -sg * ct, cg * cy - sg * sy * st_],
        ]
    )
    assert np.abs(rotation.as_matrix() - to_body.transpose(2, 1, 0)).max() < EXACT


def test_a_thrust_axis_is_the_bodys_z_and_does_not_roll():
    axes = RANDOM.normal(size=(3, 50)).cumsum(axis=1)
    axes[:, 20] = [0.0, 0.0, -2.0]
    axes[:, 21] = [0.0, 0.0, 2.0]  # the other way round
    _, rotation = pose({"axis": axes}, body(attitude=ThrustAxis(vector("ship.axis", 3))))
    unit = (axes / np.linalg.norm(axes, axis=0)).T
    assert np.abs(rotation.apply([0.0, 0.0, 1.0]) - unit).max() < EXACT
    turns = (rotation[1:] * rotation[:-1].inv()).as_rotvec()
    assert np.abs(np.sum(turns * unit[1:], axis=1)).max() < 1e-5
    assert np.abs(np.sum(turns * unit[:-1], axis=1)).max() < 1e-5


@pytest.mark.parametrize("half_angle", [0.3, 1.2, 2.0])
def test_around_a_cone_the_roll_is_the_solid_angle(half_angle):
    """Gauss and Bonnet: what is carried around a closed curve comes back rotated by the area within."""
    around = np.linspace(0.0, 2.0 * np.pi, 401)
    level = np.sin(half_angle)
    axes = np.stack([level * np.cos(around), level * np.sin(around), np.full(around.size, np.cos(half_angle))])
    _, rotation = pose({"axis": axes}, body(attitude=ThrustAxis(vector("ship.axis", 3))))
    rotated = (rotation[-1] * rotation[0].inv()).as_rotvec()
    area = 2.0 * np.pi * (1.0 - np.cos(half_angle))
    difference = np.remainder(rotated @ axes[:, 0] - area + np.pi, 2.0 * np.pi) - np.pi
    assert abs(difference) < 1e-3
    assert np.linalg.norm(np.cross(rotated, axes[:, 0])) < EXACT


WIND = ("bank", "sideslip_angle", "angle_of_attack", "flight_path_angle", "heading")
GEOGRAPHIC = Geographic(angle("longitude"), angle("latitude"), scalar("ship.height", METRE))


def geographic(rows=ROWS):
    """Return a flight of a third of the circumference down to 20 km."""
    way = np.linspace(0.0, 1.0, rows)
    return {"longitude": -3.0 + 2.0 * way, "latitude": 0.4 + 0.5 * way**2, "height": 1e5 - 8e4 * way}


def earth_fixed(longitude, latitude, distance):
    level = distance * np.cos(latitude)
    return np.array([level * np.cos(longitude), level * np.sin(longitude), distance * np.sin(latitude)])


def horizon(longitude, latitude):
    """Return east, north, up as rows."""
    return np.array(
        [
            [-np.sin(longitude), np.cos(longitude), 0.0],
            [-np.sin(latitude) * np.cos(longitude), -np.sin(latitude) * np.sin(longitude), np.cos(latitude)],
            earth_fixed(longitude, latitude, 1.0),
        ]
    )


def test_longitude_latitude_and_height():
    flight = geographic()
    position, _ = pose(flight, body(position=GEOGRAPHIC), sphere(RADIUS))
    longitude, latitude, height = flight.values()
    below = earth_fixed(longitude[-1], latitude[-1], RADIUS)
    relative = earth_fixed(longitude, latitude, RADIUS + height) - below[:, None]
    assert np.abs(position - horizon(longitude[-1], latitude[-1]) @ relative).max() < EXACT
    assert np.abs(position[:, -1] - [0.0, 0.0, 2e4]).max() < EXACT


def test_wind_angles():
    flight = geographic() | {name: RANDOM.uniform(-1.2, 1.2, size=ROWS) for name in WIND}
    declared = body(position=GEOGRAPHIC, attitude=WindAngles(*(angle(name) for name in WIND)))
    _, rotation = pose(flight, declared, sphere(RADIUS))
    for row, actual in enumerate(rotation.as_matrix()):
        at = {name: values[row] for name, values in flight.items()}
        axes = body_axes(kernel_vector(at["bank"], at["sideslip_angle"], at["angle_of_attack"]))
        in_velocity_axes = np.array([list(axes.x), list(axes.y), list(axes.z)]).T
        sine, cosine = np.sin(at["flight_path_angle"]), np.cos(at["flight_path_angle"])
        east, north = np.cos(at["heading"]), np.sin(at["heading"])
        forward = np.array([cosine * east, cosine * north, sine])
        upwards = np.array([-sine * east, -sine * north, cosine])
        velocity_axes = np.array([forward, upwards, np.cross(forward, upwards)]).T
        here, there = horizon(at["longitude"], at["latitude"]), horizon(flight["longitude"][-1], flight["latitude"][-1])
        assert np.abs(actual - there @ here.T @ velocity_axes @ in_velocity_axes).max() < EXACT


def test_without_bank_sideslip_and_attack_the_body_points_along_its_motion():
    rows = 401
    flight = geographic(rows)
    _, latitude, height = flight.values()
    rates = [np.gradient(each, edge_order=2) for each in flight.values()]
    east, north = rates[0] * np.cos(latitude) * (RADIUS + height), rates[1] * (RADIUS + height)
    flight |= dict.fromkeys(WIND, np.zeros(rows)) | {
        "heading": np.arctan2(north, east),
        "flight_path_angle": np.arctan2(rates[2], np.hypot(east, north)),
    }
    declared = body(position=GEOGRAPHIC, attitude=WindAngles(*(angle(name) for name in WIND)))
    position, rotation = pose(flight, declared, sphere(RADIUS))
    motion = np.gradient(position, axis=1, edge_order=2)
    forward = rotation.apply([1.0, 0.0, 0.0]).T
    assert np.abs(forward - motion / np.linalg.norm(motion, axis=0))[:, 1:-1].max() < 3e-5


def test_coordinates_are_taken_as_they_are_and_a_body_without_any_is_at_the_origin():
    positions = RANDOM.normal(size=(3, ROWS)) * 1e6
    position, rotation = pose({"position": positions}, body(position=cartesian()))
    assert (position == positions).all()
    assert_axes(rotation, Rotation.identity(ROWS))
    position, _ = pose({"position": positions}, body())
    assert (position == 0.0).all()


def test_what_is_not_finite_is_unknown_and_leaves_its_neighbours_alone():
    positions, axes = np.ones((3, ROWS)), np.tile([[0.0], [1.0], [0.0]], ROWS)
    positions[1, 4], axes[:, 6], axes[2, 7] = np.inf, 0.0, np.nan
    declared = body(position=cartesian(), attitude=ThrustAxis(vector("ship.axis", 3)))
    (computed,) = compute_poses(scene(declared), flown(position=positions, axis=axes))
    assert np.flatnonzero(np.isnan(computed.position).any(axis=0)).tolist() == [4]
    assert np.isnan(computed.position[:, 4]).all()
    assert np.flatnonzero(np.isnan(computed.attitude).any(axis=0)).tolist() == [6, 7]
    assert np.ptp(computed.attitude[:, [0, 5, 8, 9]], axis=1).max() < EXACT
