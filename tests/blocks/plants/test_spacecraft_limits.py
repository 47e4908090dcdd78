"""Statuses of the spacecraft, a plate without a normal, and a plant with a different density.

Truth: the declared limits; simulations that must be equal to the last bit; closed forms.
"""

import fmpy
import numpy as np
import pytest

import perilune
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.interfaces.ports.space import CelestialBody
from perilune.fmus_src.plants.spacecraft import Spacecraft, SpacecraftStatus
from tests.support.native.named_instance import NamedInstance
from tests.support.space.states import FAR, FRICTIONLESS, PARTICLES, QUIET

NAN, INFINITE = float("nan"), float("inf")
STATE = ("position", "velocity", "quaternion", "angular_momentum", "spin", "mode_displacements", "modal_momenta")
PLATE = [1.5, 0.0, -1.0, 0.0, 0.1, -0.4, 0.2, 2.2, 0.3, 0.2]
NO_NORMAL = [2.0, 0.0, 0.0, 0.0, 0.1, -0.4, 0.2, 2.2, 0.3, 0.2]


def plant(**settings):
    return NamedInstance(Spacecraft, **settings)


def plates(*rows):
    return np.vstack([np.array(rows).reshape(-1, 10), np.zeros((12 - len(rows), 10))])


def state(flown):
    return {name: flown[name].tolist() for name in STATE}


def test_good():
    assert plant().fly(1.0)["status"] == SpacecraftStatus.GOOD


def test_a_motor_gives_no_more_than_its_limit():
    flown = plant(motor_torques=[6e-3, -6e-3, 0.0, 1e-3]).fly(0.25)
    assert flown["status"] == SpacecraftStatus.TORQUE_LIMITED
    assert flown["applied_torques"].tolist() == [5e-3, -5e-3, 0.0, 1e-3]


def test_a_wheel_at_its_speed_limit_is_not_driven_on():
    flown = plant(motor_torques=[5e-3, 0.0, 0.0, 0.0], initial_wheel_speeds=[334.0, 0.0, 0.0, 0.0]).fly(0.25)
    assert flown["status"] == SpacecraftStatus.SPEED_LIMITED
    assert flown["applied_torques"][0] == 0.0


def test_each_axis_of_a_dipole_is_clipped():
    flown = plant(dipole=[7.0, -2.0, -9.0])
    assert flown["applied_dipole"].tolist() == [5.0, -2.0, -5.0]
    assert flown["status"] == SpacecraftStatus.DIPOLE_LIMITED
    clipped = plant(dipole=[5.0, -2.0, -5.0]).fly(1.0)
    assert clipped["status"] == SpacecraftStatus.GOOD
    assert state(flown.fly(1.0)) == state(clipped)


def test_a_plate_without_a_normal_is_none():
    flown = plant(plates=plates(NO_NORMAL, PLATE)).fly(1.0)
    assert flown["status"] == SpacecraftStatus.NO_NORMAL
    assert np.abs(flown["specific_force"]).max() > 0.0
    without = plant(plates=plates(PLATE)).fly(1.0)
    assert without["status"] == SpacecraftStatus.GOOD
    assert state(flown) == state(without)
    assert plant(plates=plates(NO_NORMAL))["specific_force"].tolist() == [0.0, 0.0, 0.0]


def test_the_length_of_a_normal_does_not_matter():
    longer = [PLATE[0], *(4.0 * n for n in PLATE[1:4]), *PLATE[4:]]
    assert state(plant(plates=plates(longer)).fly(1.0)) == state(plant(plates=plates(PLATE)).fly(1.0))


@pytest.mark.parametrize(("step", "status"), [(0.39, SpacecraftStatus.GOOD), (0.4, SpacecraftStatus.MODE_TOO_FAST)])
def test_a_mode_too_fast(step, status):
    """The free frequency 1.757 rad/s (that on a fixed base is 1.7) times the internal step: 0.685 and 0.703."""
    assert plant(**PARTICLES, internal_step=step).fly(0.4)["status"] == status


def test_the_method_damps_what_is_too_fast_as_its_theory_says():
    """Runge-Kutta of fourth order multiplies a free swing by 1 - x^6/144 each step, x = W h: damping x^5/144."""
    mode = {
        "mass": 1e6,
        "mode_frequency": [2.0, 0.0, 0.0, 0.0],
        "mode_damping": [0.0] * 4,
        "mode_translation": [[1.0, 0.0, 0.0], *np.zeros((3, 3))],
    }
    x, steps, heights = 0.7, 2000, []
    flown = plant(**FAR, **mode, **FRICTIONLESS, internal_step=x / 2.0, body_force=[1e3, 0.0, 0.0])
    flown.fly(4 * x / 2.0, 4).set(body_force=[0.0, 0.0, 0.0])
    for _ in range(2):
        heights.append(np.hypot(2.0 * flown["mode_displacements"][0], flown["modal_momenta"][0]))
        flown.fly(steps * x / 2.0, steps)
    assert np.log(heights[0] / heights[1]) / (steps * x) == pytest.approx(x**5 / 144.0, rel=0.1)


@pytest.mark.parametrize("name", ["motor_torques", "dipole", "body_force", "body_torque", "external_acceleration"])
@pytest.mark.parametrize("bad", [NAN, INFINITE, -INFINITE])
def test_an_input_that_is_not_finite_counts_as_zero(name, bad):
    size = 4 if name == "motor_torques" else 3
    start = {"initial_angular_velocity": [0.01, 0.02, -0.01], "internal_step": 0.25}
    for element in range(size):
        flown = plant(**start)
        flown.set(**{name: [bad if n == element else 0.0 for n in range(size)]})
        flown.fly(0.5)
        assert flown["status"] == SpacecraftStatus.NOT_FINITE
        assert state(flown) == state(plant(**start).fly(0.5))
        flown.set(**{name: [0.0] * size})
        assert flown.fly(0.5)["status"] == SpacecraftStatus.GOOD


def test_below_the_table_of_the_air():
    start = {"initial_position": [6378137.0 + 60e3, 0.0, 0.0], "internal_step": 0.25}
    assert plant(**start).fly(0.25)["status"] == SpacecraftStatus.BELOW_AIR
    assert plant(**start, **QUIET).fly(0.25)["status"] == SpacecraftStatus.GOOD


@pytest.mark.parametrize(
    ("body", "position", "speed"),
    [(CelestialBody.EARTH, 6379e3, 8e3), (CelestialBody.MOON, 1738e3, 2e3)],
)
def test_it_stops_below_the_surface(body, position, speed):
    """The first end of an internal step below the surface; nothing moves from there on."""
    start = {"initial_position": [position, 0.0, 0.0], "initial_velocity": [-speed, 0.0, 0.0]}
    flown = plant(**QUIET, **start, central_body=body, internal_step=0.125).fly(1.0)
    assert flown["status"] == SpacecraftStatus.BELOW_SURFACE
    radius = {CelestialBody.EARTH: 6378137.0, CelestialBody.MOON: 1737400.0}[body]
    assert radius - 0.125 * speed * 1.01 < np.linalg.norm(flown["position"]) < radius
    stopped = state(flown)
    flown.set(body_torque=[1.0, 1.0, 1.0])
    assert state(flown.fly(1.0)) == stopped
    assert flown["status"] == SpacecraftStatus.BELOW_SURFACE


@pytest.mark.parametrize("position", [[6e6, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 6356.7e3]])
def test_a_start_below_the_surface(position):
    flown = plant(initial_position=position).fly(1.0)
    assert flown["status"] == SpacecraftStatus.BELOW_SURFACE
    assert flown["position"].tolist() == position


def test_a_start_above_the_pole_of_the_ellipsoid():
    assert plant(**QUIET, initial_position=[0.0, 0.0, 6356.8e3])["status"] == SpacecraftStatus.GOOD


@pytest.mark.parametrize(
    "wrong",
    [
        {"inertia": np.zeros((3, 3))},
        {"inertia": np.diag([4.0, -4.0, 3.0])},
        {"inertia": np.diag([4.0, 4.0, 3e-4]), "wheel_axes": np.tile([0.0, 0.0, 1.0], (4, 1))},
        PARTICLES | {"mass": 15.0},
        PARTICLES | {"inertia": np.diag([180.0, 15.0, 120.0])},
    ],
    ids=["none", "negative", "less than that of the wheels", "mass of the modes", "inertia of the modes"],
)
def test_an_inertia_that_no_body_has(wrong):
    flown = plant(**wrong, initial_angular_velocity=[0.1, 0.0, 0.0])
    before = state(flown)
    flown.set(body_torque=[1.0, 1.0, 1.0])
    assert flown.fly(1.0)["status"] == SpacecraftStatus.NO_INERTIA
    assert state(flown) == before


DENSER = '''
from perilune import Parameter, Vector3, exp
from perilune.fmus_src.plants.spacecraft import Spacecraft


class IsothermalSpacecraft(Spacecraft):
    """A spacecraft in air of one scale height. Assumes one temperature. Source: hydrostatics."""

    scale_height = Parameter(60e3, unit="m", minimum=1.0, description="in which the density falls to 1/e")

    def air_density(self, t: float, r: Vector3) -> float:
        return 1e-11 * exp((400e3 - self.height(r)) / self.scale_height)
'''


@pytest.mark.slow  # docs/guides/exchange_a_model.md has such a class, too, which tests/docs exports
@pytest.mark.parametrize("version", [2, 3])
def test_a_class_with_another_density(version, tmp_path, monkeypatch):
    """Drag on a sphere -rho C_D A |v| v/(2 m) with the density of the class, in every flavour, with equal bits."""
    if local_platform(version) is None:
        pytest.skip("nothing is compiled here")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "isothermal.py").write_text(DENSER)
    fmus = perilune.export("isothermal.py").paths
    if version == 3:
        fmus = (*fmus, *perilune.export("isothermal.py", fmi=3).paths)
        assert fmpy.read_model_description(str(fmus[-1])).fmiVersion == "3.0"
    assert len(fmus) == version
    start = {"initial_position": [6878137.0, 0.0, 0.0], "initial_velocity": [0.0, 7e3, 3e3]}
    settings = start | {"sphere_area": 3.0, "sphere_drag": 2.0, "sphere_reflectivity": 0.0, "scale_height": 50e3}
    settings = {f"isothermal_spacecraft.{name}": setting for name, setting in settings.items()}
    flights = [perilune.simulate(fmu, set=settings, step=0.5, stop_time=2.0) for fmu in fmus]
    names = [f"isothermal_spacecraft.{name}[{k}]" for name in ("position", "specific_force") for k in (1, 2, 3)]
    for name in names:
        assert len({tuple(flight[name].tolist()) for flight in flights}) == 1, name
    rate = 2.0 * np.pi * 1.00273781191135448 / 86400.0
    wind = np.array([0.0, 7e3 - rate * 6878137.0, 3e3])
    drag = -0.5 * 1e-11 * np.exp(-2.0) * 2.0 * 3.0 / 50.0 * np.linalg.norm(wind) * wind
    # the start lies 0.0026 rad off the equator and off the x axis of the pole: 45 m of height
    np.testing.assert_allclose([flights[0][name][0] for name in names[3:]], drag, rtol=3e-3, atol=2e-9)
