"""`perilune describe`: the output for a system, an FMU and a slot equals their declarations.

Truth: the SSD and parameter sets read by lxml here, the blocks' declarations, and simulation of every FMU listed as
fitting.
"""

import json

import pytest
from lxml import etree

import perilune
from perilune.analysis.cli import main
from perilune.common.paths import SYSTEMS
from perilune.fmus_src.catalogue import catalogue
from tests.support.builders import retouched
from tests.support.fmi3.strict_fmu import TROUBLES, strict_fmu
from tests.support.foreign.odd_fmu import odd_fmu

pytestmark = pytest.mark.usefixtures("fmus")
SYSTEM = "lunar_terminal_guidance"


@pytest.fixture
def described(capsys):
    def run(*arguments):
        assert main(["describe", *arguments, "--json", "-"]) == 0
        return json.loads(capsys.readouterr().out)

    return run


def test_components_and_connections_are_those_of_the_ssd(described):
    actual = described(SYSTEM)
    root = etree.parse(SYSTEMS / SYSTEM / "SystemStructure.ssd").getroot()
    space = {"ssd": root.nsmap["ssd"]}
    assert [component["name"] for component in actual["components"]] == root.xpath(
        "//ssd:Component/@name", namespaces=space
    )
    assert sum(row["elements"] for row in actual["connections"]) == len(
        root.xpath("//ssd:Connection", namespaces=space)
    )


def test_values_come_with_the_line_that_gives_them(described):
    (guidance,) = [
        c for c in described(SYSTEM, "--set", "guidance.gravity=1.6")["components"] if c["name"] == "guidance"
    ]
    values = {row["name"]: (row["value"], row["from"], row["unit"]) for row in guidance["variables"]}
    assert values["gravity"] == (1.6, "`set`", "m/s2")
    value, origin, _ = values["target_position"]
    for index, line in enumerate(range(*_stretch(origin))):
        settings = (SYSTEMS / SYSTEM / origin.split()[0]).read_text().splitlines()[line - 1]
        assert f"guidance.target_position[{index + 1}]" in settings
        assert float(settings.split('value="')[1].split('"')[0]) == value[index]
    assert values["last_burn"][1] is None


def _stretch(origin):
    words = origin.split()
    return int(words[2]), int(words[-1]) + 1


def test_what_fits_flies_there_and_what_does_not_is_left_out(described):
    (guidance,) = [c for c in described(SYSTEM)["components"] if c["name"] == "guidance"]
    assert "astar_guidance" in guidance["fits"]
    assert "flat_moon_lander" not in guidance["fits"]
    for name in guidance["fits"]:
        if name in catalogue():
            assert perilune.simulate(SYSTEM, use={"guidance": name}, stop_time=0.2).complete


def test_an_fmu_by_its_name_and_by_its_file(described):
    actual = described("spherical_moon_lander")
    declared = catalogue()["spherical_moon_lander"].variables
    rows = {row["name"]: row for row in actual["variables"]}
    assert set(rows) == set(declared)
    assert rows["initial_velocity"]["size"] == 3
    assert rows["initial_velocity"]["value"] == declared["initial_velocity"].start
    assert rows["specific_impulse"]["minimum"] == pytest.approx(1e-3)
    assert described(actual["file"]) == actual


HOVER = '<Item name="hover" value="7" description="without wind"/>'


def test_items_of_enumerations_are_described(tmp_path, capsys):
    """Enumerations of FMUs of others, of FMI 2.0 and 3.0: with values, and descriptions where there are any."""
    path = odd_fmu(tmp_path)
    retouched(path, path, lambda text: text.replace('<Item name="hover" value="7"/>', HOVER))
    (mode,) = (row for row in perilune.describe(path)["variables"] if row["name"] == "mode")
    idle, hover = {"name": "idle", "value": 1, "description": ""}, {"name": "hover", "value": 7}
    assert mode["items"] == [idle, hover | {"description": "without wind"}]
    strict = strict_fmu(tmp_path)
    (trouble,) = (row for row in perilune.describe(strict)["variables"] if row["name"] == "trouble")
    assert [(each["value"], each["name"]) for each in trouble["items"]] == list(enumerate(TROUBLES))
    assert main(["describe", str(path)]) == main(["describe", str(strict)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "mode 1 1 idle, 7 hover (without wind)" in said
    assert "trouble 0 0 fine, 1 fails, 2 discards" in said


def test_a_slot_names_its_blocks(described):
    actual = described("terminal_guidance")
    assert {"analytic_guidance", "astar_robust_guidance"} <= set(actual["fmus"])
    assert "thrust_allocation" not in actual["fmus"]


def test_a_matrix_keeps_its_shape(described):
    rows = {row["name"]: row for row in described("entry_capsule")["variables"]}
    assert rows["inertia"]["size"] == [3, 3]
    assert rows["inertia"]["value"] == catalogue()["entry_capsule"].variables["inertia"].start


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["lunar_landng"], "no system, FMU or slot has this name; the nearest"),
        ([SYSTEM, "guidence"], "guidence: no such component; use one of"),
        (["gone.fmu"], "no such file"),
        (["spherical_moon_lander", "plant"], "an FMU has no components"),
    ],
)
def test_wrong_names_are_refused_in_one_line(arguments, words, capsys):
    assert main(["describe", *arguments]) == 2
    captured = capsys.readouterr()
    assert words in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""


@pytest.mark.parametrize("arguments", [[SYSTEM], [SYSTEM, "plant"], ["navigation"], ["kalman_navigation"]])
def test_as_text_every_variable_is_on_a_line(arguments, capsys):
    assert main(["describe", *arguments]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line == line.rstrip() for line in lines)
    if arguments == ["navigation"]:
        assert any(line.startswith("  estimated_position[3]  ") for line in lines)
