"""Space environment: published numbers, closed forms, statuses, and agreement with the environment inside the plant.

Truth: ephemerides and magnetic field from other programs at their epochs; the Earth's axes and the Sun by
`support.checks.space`; geometry. Sunlight, penumbra and umbra about the Earth are in the block's check.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.environment.space_environment import EnvironmentStatus, SpaceEnvironment
from perilune.fmus_src.interfaces.ports.space import Atmosphere, CelestialBody
from perilune.fmus_src.plants.spacecraft import Spacecraft
from tests.support.checks.space import celestial
from tests.support.native.named_instance import NamedInstance

YEAR_2025, EQUINOX, YEAR_2030 = 788961600.0, 827301600.0, 788961600.0 + 1826.0 * 86400.0  # s TT since J2000.0
SUN = {
    644155200.0: (52527504500.65292, 130546858329.23642, 56598989959.73522),
    EQUINOX: (148985269736.32874, -529495793.0454241, -229564521.56603414),
    1032976800.0: (-149905698149.28564, -5469241209.581221, -2371206264.7097197),
}  # m, from the Earth
MOON = {
    644155200.0: (-363541956.709677, 39574371.87641143, 53679099.033400945),
    EQUINOX: (340517897.0930472, 117608917.98089932, 76298572.17629912),
    1032976800.0: (73637238.62595679, 358910853.070476, 126617246.58165197),
}
# By ppigrf 2.1.0: position (m), epoch, flux density (T), planet-fixed.
FIELD = [
    ((6878137.0, 0.0, 0.0), YEAR_2025, (1.0816759092913277e-05, -1.686234679152024e-06, 2.15507507685104e-05)),
    ((-3.1e6, 4.2e6, 4.5e6), YEAR_2025, (2.6385025558643244e-05, -3.074009808191102e-05, -6.551557413557996e-06)),
]
OUTPUTS = (
    "sun_direction", "sun_distance", "moon_position", "illumination", "magnetic_field", "magnetic_field_body",
    "density", "planet_angle",
)  # fmt: skip
ORBIT = [6878137.0, 0.0, 0.0]
seeds = st.integers(0, 2**32 - 1)


def surroundings(**settings):
    return NamedInstance(SpaceEnvironment, **settings)


def outputs(block):
    return {name: np.asarray(block[name]).tolist() for name in OUTPUTS}


def fixed_axes(epoch):
    """Return rotation from inertial to planet-fixed axes, apart from the block's code."""
    return celestial.earth_fixed(epoch, celestial.earth_pole(epoch), 69.184)


@pytest.mark.parametrize("epoch", SUN)
@pytest.mark.parametrize("body", [CelestialBody.EARTH, CelestialBody.MOON])
def test_sun_and_moon(epoch, body):
    """From the spacecraft the Sun, from the body's centre the Moon."""
    sun, moon, position = (np.array(v) for v in (SUN[epoch], MOON[epoch], [3e6, -4e6, 5e6]))
    block = surroundings(epoch=epoch, position=position, central_body=body)
    away = sun - position
    if body == CelestialBody.MOON:
        away, moon = away - moon, np.zeros(3)
    assert block["sun_distance"] == pytest.approx(np.linalg.norm(away), rel=1e-12)
    np.testing.assert_allclose(block["sun_direction"], away / np.linalg.norm(away), atol=1e-12)
    np.testing.assert_allclose(block["moon_position"], moon, rtol=1e-11)


@pytest.mark.parametrize(("position", "epoch", "field"), FIELD)
def test_magnetic_field(position, epoch, field):
    axes = fixed_axes(epoch)
    block = surroundings(epoch=epoch, position=axes.T @ position, magnetic_degree=13)
    np.testing.assert_allclose(axes @ block["magnetic_field"], field, atol=1e-13 * np.linalg.norm(field))


def test_air_above_the_equator():
    """Vallado's table, rows and between them; nothing without an atmosphere."""
    axes = fixed_axes(EQUINOX)
    heights = {
        150e3: 2.07e-09,
        225e3: 1.4217940148293663e-10,
        410e3: 3.1398357840164125e-12,
        777e3: 1.516488408101019e-14,
    }
    for height, density in heights.items():
        position = axes.T @ [6378137.0 + height, 0.0, 0.0]
        block = surroundings(atmosphere=Atmosphere.EXPONENTIAL, density_factor=2.5, position=position)
        assert block["density"] == pytest.approx(2.5 * density, rel=1e-11)
        assert surroundings(atmosphere=Atmosphere.VACUUM, position=position)["density"] == 0.0


@pytest.mark.parametrize("atmosphere", [Atmosphere.EXPONENTIAL, Atmosphere.HARRIS_PRIESTER])
def test_air_below_its_table(atmosphere):
    """The density of 100 km: 5.297e-7 kg/m3 of Vallado, 4.974e-7 of Harris and Priester, both without a bulge."""
    axes, density = fixed_axes(EQUINOX), {Atmosphere.EXPONENTIAL: 5.297e-7, Atmosphere.HARRIS_PRIESTER: 4.974e-7}
    for height, status in [(100.001e3, EnvironmentStatus.GOOD), (60e3, EnvironmentStatus.BELOW_AIR)]:
        block = surroundings(atmosphere=atmosphere, position=axes.T @ [6378137.0 + height, 0.0, 0.0])
        assert block["status"] == status
        assert block["density"] == pytest.approx(density[atmosphere], rel=2e-4)
    assert (
        surroundings(atmosphere=Atmosphere.VACUUM, position=[6438137.0, 0.0, 0.0])["status"] == EnvironmentStatus.GOOD
    )


def test_the_prime_meridian_turns_once_in_a_sidereal_day():
    turn = 86400.0 / 1.00273781191135448
    block = surroundings(epoch=EQUINOX)
    meridian = fixed_axes(EQUINOX)[0]  # which lies off the x axis of the pole by this angle
    assert block["planet_angle"] == pytest.approx(np.arctan2(meridian[1], meridian[0]), abs=1e-5)
    first = block["planet_angle"]
    for _ in range(4):
        assert 0.0 <= block.fly(turn / 4.0)["planet_angle"] < 2.0 * np.pi
    assert block["planet_angle"] == pytest.approx(first, abs=1e-8)


def test_about_the_moon():
    """Neither field nor air; shadow of its sphere, on whose axis all is dark and at whose side all is light."""
    sun = np.subtract(SUN[EQUINOX], MOON[EQUINOX])
    ahead = sun / np.linalg.norm(sun)
    across = np.cross(ahead, [0.0, 0.0, 1.0])
    for position, light in [(-2e6 * ahead, 0.0), (2e6 * ahead, 1.0), (2e6 * across, 1.0)]:
        block = surroundings(central_body=CelestialBody.MOON, position=position)
        assert block["illumination"] == light
        assert block["density"] == 0.0
        assert not block["magnetic_field"].any()
        assert block["status"] == EnvironmentStatus.GOOD


@pytest.mark.parametrize(
    ("epoch", "status"), [(YEAR_2025, 0), (YEAR_2025 - 1.0, 1), (YEAR_2030 - 1.0, 0), (YEAR_2030, 0)]
)
def test_years_of_the_field(epoch, status):
    assert surroundings(epoch=epoch)["status"] == status


def test_a_flight_leaves_the_years_of_the_field():
    block = surroundings(epoch=YEAR_2030 - 10.0)
    statuses = [block.fly(4.0)["status"] for _ in range(4)]
    assert statuses == [EnvironmentStatus.GOOD] * 2 + [EnvironmentStatus.OUTSIDE_YEARS] * 2


@pytest.mark.parametrize(
    "wrong",
    [
        *({"position": [bad if n == k else 7e6 for n in range(3)]} for k in range(3) for bad in (np.nan, np.inf)),
        *({"quaternion": [bad if n == k else 0.6 for n in range(4)]} for k in range(4) for bad in (np.nan, -np.inf)),
        {"quaternion": [0.0, 0.0, 0.0, 0.0]},
        {"quaternion": [0.2, 0.2, 0.2, 0.2]},
        {"position": [0.0, 0.0, 0.0]},
        {"position": [6378e3, 0.0, 0.0]},
        {"position": [0.0, 0.0, -6356e3]},
    ],
    ids=str,
)
def test_outputs_are_held(wrong):
    block = surroundings(position=ORBIT).fly(1.0)
    before = outputs(block)
    block.set(**wrong)
    assert block.fly(100.0)["status"] == EnvironmentStatus.UNCHANGED
    assert outputs(block) == before
    block.set(position=ORBIT, quaternion=[1.0, 0.0, 0.0, 0.0])
    assert block.fly(100.0)["status"] == EnvironmentStatus.GOOD
    assert outputs(block) != before


def test_the_surface_of_the_moon():
    statuses = [
        surroundings(central_body=CelestialBody.MOON, position=[0.0, radius, 0.0])["status"]
        for radius in (1737300.0, 1737500.0)
    ]
    assert statuses == [EnvironmentStatus.UNCHANGED, EnvironmentStatus.GOOD]


@given(seeds, st.floats(0.6, 3.0))
def test_the_field_in_body_axes(seed, length):
    """Turned by the attitude, of whatever length the quaternion is."""
    random = np.random.default_rng(seed)
    q = random.normal(size=4)
    q *= length / np.linalg.norm(q)
    position = random.normal(size=3)
    block = surroundings(position=7.2e6 * position / np.linalg.norm(position), quaternion=q)
    expected = Rotation.from_quat(q, scalar_first=True).inv().apply(block["magnetic_field"])
    np.testing.assert_allclose(block["magnetic_field_body"], expected, atol=1e-19)


@given(seeds, st.integers(1, 13))
def test_the_plant_has_the_same_surroundings(seed, degree):
    """Its disturbance torque is that of its residual dipole in this field; its drag that of this density."""
    random = np.random.default_rng(seed)
    position, q, dipole = random.normal(size=3), random.normal(size=4), random.normal(size=3)
    position, q = 6.9e6 * position / np.linalg.norm(position), q / np.linalg.norm(q)
    block = surroundings(position=position, quaternion=q, magnetic_degree=degree)
    plant = {"initial_position": position, "initial_velocity": [0.0, 0.0, 0.0], "initial_quaternion": q}
    common = {"magnetic_degree": degree, "inertia": 3.0 * np.eye(3)}
    magnetic = NamedInstance(Spacecraft, **plant, **common, residual_dipole=dipole)
    torque = np.cross(dipole, block["magnetic_field_body"])
    np.testing.assert_allclose(magnetic["disturbance_torque"], torque, atol=1e-17)
    spacecraft = NamedInstance(Spacecraft, **plant, sphere_area=2.0, sphere_drag=2.0, sphere_reflectivity=0.0)
    wind = celestial.EARTH_RATE * np.cross(celestial.earth_pole(EQUINOX)[2], position)
    force = 0.5 * block["density"] * 2.0 * 2.0 * np.linalg.norm(wind) * wind / 50.0
    felt = Rotation.from_quat(q, scalar_first=True).apply(spacecraft["specific_force"])
    np.testing.assert_allclose(felt, force, rtol=1e-9, atol=1e-24)
