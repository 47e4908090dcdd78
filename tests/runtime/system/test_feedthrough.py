"""FMUs without declared dependencies of outputs on inputs: order of execution, and reported assumptions.

Truth: results by hand, as in test_schedule.py. A gain that declares its feedthrough responds at the same time; a gain
that does not declare it responds one step later, unless the user or the SSD states that it is direct.
"""

import json
import re

import numpy as np
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.commands.campaigns import replay_command
from perilune.analysis.runtime.system.feedthrough import Origin
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from perilune.common.paths import FLAVOURS
from tests.support.builders import component, connection, document, fly, pack, retouched, system
from tests.support.lengths import either

RAMP = component("ramp", "ramp", "output y Real m")
GAIN_ENDS = "input u Real m; output y Real m"
DELAY = component("delay", "delay", GAIN_ENDS)
WIRES = connection("ramp.y", "gain.u") + connection("gain.y", "delay.u")


def without_dependencies(text):
    actual = re.sub(r'(<Unknown index="\d+") dependencies="[^"]*"( dependenciesKind="[^"]*")?', r"\1", text)
    assert actual != text
    return actual


def without_outputs(text):
    return re.sub(r"<Outputs>.*?</Outputs>", "", text, flags=re.DOTALL)


LONG_FORMS = [(flavour, way) for way in (without_dependencies, without_outputs) for flavour in FLAVOURS]
FORMS = either(LONG_FORMS, [("native", without_dependencies), ("python", without_outputs)])
FEWER_FORMS = pytest.mark.parametrize("undeclared", either(FORMS, FORMS[:1]), indirect=True)


@pytest.fixture(params=FORMS, ids=lambda form: f"{form[1].__name__}-{form[0]}")
def undeclared(tiny_folder, tmp_path, request):
    """Write a folder of tiny FMUs of a flavour, gain and cross of which declare no dependencies of their outputs."""
    flavour, change = request.param
    tiny = tiny_folder / flavour
    for name in ("ramp", "delay", "gain"):
        (tmp_path / f"{name}.fmu").write_bytes((tiny / f"{name}.fmu").read_bytes())
    for name in ("gain", "cross"):
        retouched(tiny / f"{name}.fmu", tmp_path / f"open_{name}.fmu", change)
    return tmp_path


def chain(folder, fmu="open_gain", extra="", name="s"):
    gain = component("gain", fmu, GAIN_ENDS).replace("</ssd:Component>", f"{extra}</ssd:Component>")
    return pack(folder / f"{name}.ssp", folder, document(system(gain, DELAY, RAMP, connections=WIRES)))


def says(direct):
    return (
        '<ssd:Annotations><ssc:Annotation type="org.perilune.feedthrough">'
        f'<Feedthrough xmlns="https://perilune.org/feedthrough" direct="{direct}"/></ssc:Annotation></ssd:Annotations>'
    )


def test_a_step_late_without_a_word_and_settled_at_the_start(undeclared):
    result = fly(chain(undeclared))
    assert result["ramp.y"].tolist() == [1.0, 1.5, 2.0, 2.5, 3.0]
    assert result["gain.y"].tolist() == [3.0, 3.0, 4.5, 6.0, 7.5]  # the first as if direct: no loop forbids it
    assert result["delay.u"].tolist() == result["gain.y"].tolist()


def test_bit_equal_to_a_declared_one_with_the_option_or_the_annotation(undeclared):
    declared = fly(chain(undeclared, "gain", name="declared"))
    by_option = fly(chain(undeclared), feedthrough=("gain",))
    by_annotation = fly(chain(undeclared, extra=says("true"), name="annotated"))
    assert declared["gain.y"].tolist() == [3.0, 4.5, 6.0, 7.5, 9.0]
    for result in (by_option, by_annotation):
        assert result.signals.keys() == declared.signals.keys()
        for name, values in declared.signals.items():
            assert np.array_equal(result[name], values), name


def test_said_to_have_none_its_start_waits_for_nothing(undeclared):
    annotated = chain(undeclared, extra=says("false"), name="annotated")
    for path, options in ((chain(undeclared), {"no_feedthrough": ("gain",)}), (annotated, {})):
        assert fly(path, **options)["gain.y"].tolist() == [0.0, 3.0, 4.5, 6.0, 7.5]
        assert prepare_system(path, SystemOptions(**options)).assumptions == []


def test_the_command_line_goes_before_the_annotation_which_speaks_of_its_own_fmu(undeclared):
    path = chain(undeclared, extra=says("false"))

    def origin(**options):
        feedthrough = prepare_system(path, SystemOptions(**options)).schedule.feedthrough
        return any(feedthrough.stepping["gain"].values()), feedthrough.origins["gain"]

    assert origin() == (False, Origin.SSD)
    assert origin(feedthrough=("gain",)) == (True, Origin.OPTION)
    assert origin(use={"gain": str(undeclared / "gain.fmu")}) == (True, Origin.FMU)
    assert origin(use={"gain": str(undeclared / "open_gain.fmu")}) == (False, Origin.ASSUMED)


def test_a_loop_is_cut_at_the_first_undeclared_one_and_listed(undeclared):
    """ramp -> a.a -> a.ya -> b.a -> b.ya -> a.b: nobody says that a.b has nothing to do with a.ya."""
    ends = "input a Real m; input b Real m; output ya Real m; output yb Real m"
    parts = [component(name, "open_cross", ends) for name in "ab"]
    wires = connection("ramp.y", "a.a") + connection("a.ya", "b.a") + connection("b.ya", "a.b")
    wires += connection("ramp.y", "b.b")
    path = pack(undeclared / "loop.ssp", undeclared, document(system(RAMP, *parts, connections=wires)))
    prepared = prepare_system(path)
    assert prepared.schedule.feedthrough.undeclared == ("a", "b")
    assert prepared.schedule.feedthrough.cuts == ("b.ya -> a.b",)
    result = fly(path)
    assert result["a.ya"].tolist() == [2.0, 2.0, 3.0, 4.0, 5.0]
    assert result["b.ya"].tolist() == [4.0, 4.0, 4.0, 6.0, 8.0]
    assert result["a.yb"].tolist() == [1.5, 5.0, 5.0, 5.0, 7.0]  # its start value, then what b gave one step ago
    with pytest.raises(InputError, match="algebraic loop"):
        prepare_system(path, SystemOptions(feedthrough=("a", "b")))
    assert prepare_system(path, SystemOptions(feedthrough=("a",))).schedule.feedthrough.cuts == ("a.ya -> b.a",)


def test_jacobi_gives_everyone_the_inputs_of_the_start_so_nothing_is_assumed(undeclared):
    prepared = prepare_system(chain(undeclared), SystemOptions(algorithm="jacobi"))
    assert prepared.assumptions == []
    assert fly(chain(undeclared), algorithm="jacobi")["gain.y"].tolist() == [3.0, 3.0, 4.5, 6.0, 7.5]


def test_an_fmu_alone_keeps_the_order_of_fmpy(undeclared):
    alone = undeclared / "open_gain.fmu"
    assert prepare_system(alone).assumptions == []
    with pytest.raises(InputError, match=r"feedthrough: gain: an FMU alone is stepped with inputs from the start of"):
        prepare_system(alone, SystemOptions(feedthrough=("gain",)))


def test_refusals(undeclared):
    path = chain(undeclared)
    with pytest.raises(
        InputError, match=r"feedthrough: gain: is also given to no_feedthrough; give the component to only one"
    ):
        prepare_system(path, SystemOptions(feedthrough=("gain",), no_feedthrough=("gain",)))
    with pytest.raises(InputError, match=r"feedthrough: nobody: no such component; use one of delay, gain, ramp"):
        prepare_system(path, SystemOptions(feedthrough=("nobody",)))
    with pytest.raises(InputError, match=r"Feedthrough \(line 6\): direct is 'maybe'; write direct=\"true\" or"):
        prepare_system(chain(undeclared, extra=says("maybe"), name="wrong"))
    double = says("true").replace("</ssd:Annotations>", says("true").removeprefix("<ssd:Annotations>"))
    with pytest.raises(InputError, match=r"a second annotation of type org\.perilune\.feedthrough; write only one"):
        prepare_system(chain(undeclared, extra=double, name="twice"))
    misplaced = document(system(RAMP, extra=says("true")))
    with pytest.raises(
        InputError,
        match=r"org\.perilune\.feedthrough is not permitted in a System; move the annotation into a Component",
    ):
        prepare_system(pack(undeclared / "misplaced.ssp", undeclared, misplaced))


def test_what_is_assumed_is_said_where_one_looks(undeclared, capsys):
    path = str(chain(undeclared))
    words = "gain: FMU gain does not declare which outputs depend directly on inputs"
    assert main(["validate", path]) == 0
    assert words in " ".join(capsys.readouterr().out.split())
    assert main(["run", path]) == 0
    assert capsys.readouterr().out.count(words) == 1
    assert main(["run", path, "--feedthrough", "gain"]) == 0
    assert "does not declare" not in capsys.readouterr().out
    assert main(["describe", path]) == 0
    assert re.search(r"gain +none, assumed, since the FMU does not declare it", capsys.readouterr().out)
    assert main(["describe", path, "gain", "--feedthrough", "gain"]) == 0
    assert "feedthrough     direct, stated by an option" in capsys.readouterr().out
    assert main(["describe", str(undeclared / "open_gain.fmu")]) == 0
    assert "feedthrough     not declared for y" in capsys.readouterr().out


CAMPAIGN = """
system = "s.ssp"
trials = 2
seed = 3

[draw."ramp.slope"]
distribution = "uniform"
low = 1
high = 3

[metric.end]
expression = "gain.y"
reduction = "final"

[success]
expression = "end > 0"
"""


@FEWER_FORMS
def test_a_campaign_keeps_the_option_and_its_page_says_what_is_assumed(undeclared, tmp_path):
    path, campaign = chain(undeclared), tmp_path / "ends.toml"
    campaign.write_text(CAMPAIGN)
    late = perilune.batch(path, campaign, workers=1, output=tmp_path / "late")
    direct = perilune.batch(path, campaign, workers=1, output=tmp_path / "direct", feedthrough=["gain"])
    slope = late.table()["draw.ramp.slope"].to_numpy()
    assert late.table()["metric.end"].to_numpy() == pytest.approx(3.0 * (1.0 + 0.75 * slope))
    assert direct.table()["metric.end"].to_numpy() == pytest.approx(3.0 * (1.0 + slope))
    manifest = json.loads((tmp_path / "direct" / "manifest.json").read_text())
    assert (manifest["options"]["feedthrough"], manifest["options"]["no_feedthrough"]) == (["gain"], [])
    repeated = perilune.merge(tmp_path / "direct")
    assert repeated.plan.options.chosen["feedthrough"] == ("gain",)
    command = replay_command(direct.plan, direct.plan.campaign.variants()[0], 1)
    assert "feedthrough gain" in command
    for result, is_said in ((late, True), (direct, False)):
        result.report(tmp_path / "page.html")
        assert ("Assumed: gain: FMU gain does not declare" in (tmp_path / "page.html").read_text()) is is_said
        assert ("assumed: gain: FMU gain does not declare" in result.text()) is is_said
    perilune.compare([tmp_path / "late", tmp_path / "direct"]).report(tmp_path / "page.html")
    (line,) = re.findall("[^>]*does not declare[^<]*", (tmp_path / "page.html").read_text())
    assert line.startswith("late: assumed: gain: FMU gain")


@FEWER_FORMS
@pytest.mark.parametrize(
    ("study", "options"),
    [
        (perilune.rare, {"failure": "end > 7", "samples": 100}),
        (perilune.worst, {"metric": "end", "flights": 100}),
        (perilune.sensitivity, {"base": 32}),
    ],
)
def test_studies_say_what_is_assumed(study, options, undeclared, tmp_path):
    path, campaign = chain(undeclared), tmp_path / "ends.toml"
    campaign.write_text(CAMPAIGN)
    for said in ((), ("gain",)):
        result = study(path, campaign, workers=1, feedthrough=said, **options)
        assert ("assumed: gain: FMU gain does not declare" in "\n".join(result.lines())) is (not said)
        if not said:
            result.report(tmp_path / "page.html")
            assert "Assumed: gain: FMU gain does not declare" in (tmp_path / "page.html").read_text()


def test_the_page_of_a_run_says_what_is_assumed(undeclared, tmp_path):
    for options, is_said in (({}, True), ({"no_feedthrough": ["gain"]}, False)):
        perilune.simulate(chain(undeclared), **options).report(tmp_path / "page.html")
        assert ("Assumed: gain: FMU gain does not declare" in (tmp_path / "page.html").read_text()) is is_said
