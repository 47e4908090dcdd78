"""Replacement of a component's FMU: a compatible FMU runs, any other is refused with the missing connector.

Truth: the connectors of the FMUs; guidances that share an interface; gains with known factors.
"""

import shutil

import pytest

import perilune
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, fly, pack, retouched, system

LANDER = "lunar_terminal_guidance"
GUIDANCES = (
    "analytic_guidance",
    "analytic_exact_guidance",
    "astar_guidance",
    "astar_robust_guidance",
    "astar_modified_guidance",
)


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("guidance", GUIDANCES)
def test_every_guidance_fits_the_slot_of_guidance(guidance):
    result = perilune.simulate(LANDER, use={"guidance": guidance}, stop_time=1.0)
    assert result.provenance["fmus"]["guidance"]["fmu"] == guidance
    assert result.complete


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", ["python", "native"])
def test_ideal_navigation_is_the_noisy_one_without_noise(flavour):
    """The slot's default with all its sigmas 0 is the truth too; the swapped one has connectors fewer."""
    default = perilune.simulate(LANDER, flavour=flavour, stop_time=20.0)
    ideal = perilune.simulate(LANDER, use={"navigation": "ideal_navigation"}, flavour=flavour, stop_time=20.0)
    assert default["plant.position[1]"].tolist() == ideal["plant.position[1]"].tolist()
    assert set(ideal.signals) < set(default.signals)
    assert "navigation.innovation_square" in set(default.signals) - set(ideal.signals)


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(
    ("slot", "fmu", "missing"),
    [
        ("guidance", "flat_moon_lander", "guidance.position[1]"),
        ("guidance", "ideal_navigation", "guidance.mass"),
        ("navigation", "analytic_guidance", "navigation.specific_force[1]"),
        ("plant", "thrust_allocation", "plant.thrust"),
    ],
)
def test_an_fmu_without_the_connectors_is_refused(slot, fmu, missing):
    with pytest.raises(InputError) as caught:
        perilune.simulate(LANDER, use={slot: fmu})
    text = str(caught.value)
    assert missing in text
    assert f"{fmu}.fmu" in text
    assert "; these fit: " in text
    assert "\n" not in text


RAMP = component("ramp", "ramp", "output y Real m")
GAIN = component("gain", "gain", "input u Real m; output y Real m")


@pytest.fixture
def path(tiny, tmp_path):
    return pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=connection("ramp.y", "gain.u"))))


def test_by_path_with_connectors_beyond_those_of_the_slot(tiny, path, tmp_path):
    def rename(text):
        return text.replace('name="a"', 'name="u"').replace('name="ya"', 'name="y"')

    other = retouched(tiny / "cross.fmu", tmp_path / "other.fmu", rename)
    result = fly(path, use={"gain": str(other)})
    assert result["gain.y"].tolist() == [2.0, 3.0, 4.0, 5.0, 6.0]
    assert result["gain.yb"].tolist() == [1.5] * 5  # b keeps its start value


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: text.replace('name="y"', 'name="z"'), r"gain\.y: .*no variable of this name"),
        (
            lambda text: text.replace('causality="output"', 'causality="local"'),
            r"gain\.y: .*is local in .*, but output here",
        ),
        (lambda text: text.replace('unit="m"', 'unit="1"'), r"gain\.u: .*unit is 1 in .*, but m here"),
        (
            lambda text: text.replace('<Real start="0.0" unit="m"/>', '<Integer start="0"/>').replace(
                'input" variability="continuous"', 'input" variability="discrete"'
            ),
            r"gain\.u: .*is Integer in .*, Real here",
        ),
    ],
    ids=["missing connector", "wrong causality", "wrong unit", "wrong type"],
)
def test_connectors_that_do_not_fit_are_refused(tiny, path, tmp_path, change, words):
    def changed(text):
        text = change(text)
        return (
            text
            if 'causality="local"' not in text
            else text.split("<ModelStructure")[0] + "<ModelStructure/>\n" + ("</fmiModelDescription>")
        )

    other = retouched(tiny / "gain.fmu", tmp_path / "other.fmu", changed)
    with pytest.raises(InputError, match=words):
        fly(path, use={"gain": str(other)})


def test_a_stranger_without_units_fits(tiny, path, tmp_path):
    shutil.copy(tiny / "stranger.fmu", tmp_path / "odd.fmu")
    result = fly(path, use={"gain": str(tmp_path / "odd.fmu")})
    assert result["gain.y"].tolist() == [2.0, 2.0, 2.5, 3.0, 3.5]  # undeclared: u of the step's start
    assert fly(path, use={"gain": str(tmp_path / "odd.fmu")}, feedthrough=("gain",))["gain.y"].tolist()[1:3] == [2.5, 3]


def test_one_fmu_in_two_slots_keeps_two_states(tiny, tmp_path):
    delays = [component(name, "delay", "input u Real m; output y Real m") for name in ("first", "second")]
    wires = connection("ramp.y", "first.u") + connection("first.y", "second.u")
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, *delays, connections=wires)))
    result = fly(path, set={"second.start": 9.0})
    assert result["first.y"].tolist() == [5.0, 1.0, 1.5, 2.0, 2.5]
    assert result["second.y"].tolist() == [9.0, 5.0, 1.0, 1.5, 2.0]
