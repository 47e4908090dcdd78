"""Plants simulated by Basilisk: the example and the plant of the guide. `make basilisk` runs these tests with Basilisk.

Truth: Kepler's equation; Newton's law; the same simulations with Perilune's plant, to second order in the example's
step.
"""

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.common.paths import ROOT
from tests.support.documented import page_text, saved_files

pytest.importorskip("Basilisk", reason="`make basilisk` installs it")
GUIDE = page_text("docs/guides/basilisk.md")
EXAMPLE = ROOT / "examples" / "basilisk_moon_lander.py"
MU = 3.986004418e14


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """Return a folder with both FMUs."""
    folder = tmp_path_factory.mktemp("basilisk")
    ((name, text),) = saved_files(GUIDE)
    (folder / name).write_text(text)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert main(["export", name]) == 0
        assert main(["export", str(EXAMPLE)]) == 0
    return folder / "build" / "fmus" / "python"


def test_the_guide_has_forty_lines():
    ((_, text),) = saved_files(GUIDE)
    assert len([line for line in text.splitlines() if line.strip()]) <= 40


def test_an_orbit_is_keplers(exported):
    radius, speed = 7e6, 7546.0
    flight = perilune.simulate(exported / "basilisk_orbiter.fmu", step=10.0, stop_time=5800.0)
    axis = 1.0 / (2.0 / radius - speed**2 / MU)
    eccentricity = abs(1.0 - radius / axis)
    mean = np.sqrt(MU / axis**3) * flight.time  # the start is an apsis
    from_periapsis = mean if radius < axis else mean + np.pi
    anomaly = from_periapsis.copy()
    for _ in range(20):
        anomaly -= (anomaly - eccentricity * np.sin(anomaly) - from_periapsis) / (1.0 - eccentricity * np.cos(anomaly))
    distance = axis * (1.0 - eccentricity * np.cos(anomaly))
    actual = np.linalg.norm(flight["basilisk_orbiter.position"], axis=1)
    np.testing.assert_allclose(actual, distance, rtol=1e-11)


def test_a_force_gives_its_impulse(exported):
    fmu = exported / "basilisk_orbiter.fmu"
    forced, free = (
        perilune.simulate(fmu, step=0.1, stop_time=0.1, set={"basilisk_orbiter.internal_step": 0.1, **force})
        for force in ({"basilisk_orbiter.force[3]": 75.0}, {})
    )
    gained = forced["basilisk_orbiter.velocity"][-1] - free["basilisk_orbiter.velocity"][-1]
    np.testing.assert_allclose(gained, [0.0, 0.0, 0.01], atol=1e-9)


def test_a_landing_is_that_of_our_plant_to_second_order(exported):
    apart = []
    for step in (0.1, 0.05):
        values = {"parameters": ["ideal.ssv"], "set": {"plant.internal_step": step}}
        law = {"guidance": "analytic_exact_guidance"}
        ours = perilune.simulate("lunar_landing", use=law, **values)
        other = perilune.simulate("lunar_landing", use=law | {"plant": exported / "basilisk_moon_lander.fmu"}, **values)
        assert ours.time[-1] == other.time[-1]
        apart.append(
            [np.abs(ours[name] - other[name]).max() for name in ("plant.position", "plant.velocity", "plant.mass")]
        )
    assert np.all(np.array(apart[0]) < [0.05, 5e-4, 1e-4])
    np.testing.assert_allclose(np.divide(*apart), 4.0, rtol=0.1)


def test_trials_do_not_depend_on_workers_or_order(exported, tmp_path):
    for workers in (1, 2):
        perilune.batch(
            "lunar_landing",
            "compare",
            use={"plant": exported / "basilisk_moon_lander.fmu"},
            configuration="astar_guidance",
            trials=6,
            workers=workers,
            output=tmp_path / str(workers),
        )
    first, second = ((tmp_path / each / "trials" / "000000.parquet").read_bytes() for each in ("1", "2"))
    assert first == second
    for trial in (4, 1):
        assert perilune.replay(tmp_path / "1", trial, configuration="astar_guidance").differences == ()


def test_wrong_parameters_are_refused_by_name(exported, capsys):
    wrong = {"dry_mass=2000": "does not exceed dry_mass", "internal_step=0.03": "not a multiple of internal_step"}
    for values, problem in wrong.items():
        options = ["--use", f"plant={exported / 'basilisk_moon_lander.fmu'}", "--set", f"plant.{values}"]
        assert main(["run", "lunar_landing", *options]) != 0
        printed = capsys.readouterr()
        assert problem in printed.out + printed.err
