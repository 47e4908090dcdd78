"""Communication steps and algorithms declared in systems by other tools.

Truth: the same system with this step and algorithm as options; a recursion by hand for inner systems with a separate
step.
"""

import numpy as np
import pytest

from perilune.analysis.cli import main
from perilune.common.errors import InputError
from tests.support.builders import component, connection, document, fly, pack, system

RAMP = component("ramp", "ramp", "output y Real m")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
WIRED = connection("ramp.y", "gain.u")
OMS = 'xmlns:oms="https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd"'
OSP = 'xmlns:osp="http://opensimulationplatform.com/SSP/OSPAnnotations"'


def annotated(kind, content):
    return f'<ssd:Annotations><ssc:Annotation type="{kind}">{content}</ssc:Annotation></ssd:Annotations>'


def openmodelica(master):
    inside = f"<oms:SimulationInformation>{master}</oms:SimulationInformation>"
    return annotated("org.openmodelica", f"<oms:Annotations {OMS}>{inside}</oms:Annotations>")


def fixed(step):
    return openmodelica(f'<oms:FixedStepMaster description="oms-ma" stepSize="{step}" relativeTolerance="1e-4"/>')


def osp(step, kind="com.opensimulationplatform"):
    content = f'<osp:Algorithm {OSP}><osp:FixedStepAlgorithm baseStepSize="{step}"/></osp:Algorithm>'
    experiment = f'stopTime="1.0">{annotated(kind, content)}</ssd:DefaultExperiment>'
    return document(system(RAMP, GAIN, connections=WIRED), step=None).replace(
        'stopTime="1.0"></ssd:DefaultExperiment>', experiment
    )


@pytest.mark.parametrize(
    "text",
    [
        osp(0.125),
        osp(0.125, "com.github.ntnu-ihb.vico"),
        document(system(RAMP, GAIN, connections=WIRED, extra=fixed(0.125)), step=None),
    ],
    ids=["osp", "vico", "openmodelica"],
)
def test_step_and_algorithm_are_those_of_the_annotation(tiny, tmp_path, text):
    path = pack(tmp_path / "s.ssp", tiny, text)
    plain = pack(tmp_path / "plain.ssp", tiny, document(system(RAMP, GAIN, connections=WIRED)))
    actual = fly(path)
    assert (actual.provenance["step"], actual.provenance["algorithm"]) == (0.125, "jacobi")
    np.testing.assert_array_equal(actual["gain.y"], fly(plain, step=0.125, algorithm="jacobi")["gain.y"])
    requested = fly(path, step=0.25, algorithm="sequential")
    np.testing.assert_array_equal(requested["gain.y"], fly(plain)["gain.y"])


def hinted(step):
    hint = annotated("com.opensimulationplatform", f'<osp:StepSizeHint {OSP} value="{step}"/>')
    gain = GAIN.replace("</ssd:Component>", f"{hint}</ssd:Component>")
    return document(system(RAMP, gain, connections=WIRED))


def test_a_hint_of_zero_is_none(tiny, tmp_path):
    path = pack(tmp_path / "s.ssp", tiny, hinted("0.0"))
    plain = pack(tmp_path / "plain.ssp", tiny, document(system(RAMP, GAIN, connections=WIRED)))
    np.testing.assert_array_equal(fly(path)["gain.y"], fly(plain)["gain.y"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (hinted("-1"), r"StepSizeHint \(line \d+\): value '-1' is not a positive number of seconds; write value="),
        (
            osp("0").replace("baseStepSize", "stepSize"),
            r"FixedStepAlgorithm \(line \d+\): stepSize '0' is not a positive number of seconds; write stepSize=",
        ),
    ],
)
def test_a_bad_step_is_named_by_its_attribute(tiny, tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        fly(pack(tmp_path / "s.ssp", tiny, text))


def test_ours_goes_before_theirs(tiny, tmp_path):
    text = document(system(RAMP, GAIN, connections=WIRED, extra=fixed(0.125)))
    assert fly(pack(tmp_path / "s.ssp", tiny, text)).provenance["step"] == 0.25


def test_a_master_that_varies_its_step_asks_for_one(tiny, tmp_path):
    master = openmodelica('<oms:VariableStepMaster description="oms-mav" maximumStepSize="0.1"/>')
    path = pack(tmp_path / "s.ssp", tiny, document(system(RAMP, GAIN, connections=WIRED, extra=master), step=None))
    with pytest.raises(
        InputError, match=r"step \(line \d+\): a variable step is not supported; give a fixed step with step"
    ):
        fly(path)
    assert fly(path, step=0.5).provenance["algorithm"] == "jacobi"


def test_an_inner_system_with_a_shorter_step(tiny, tmp_path):
    """The inner ramp and delay exchange every 0.125 s; the outer delay steps by 0.5 s and reads what is there then."""
    delay = component("delay", "delay", "input u Real m; output y Real m")
    inner = system(
        RAMP,
        delay,
        connections=connection("ramp.y", "delay.u") + connection("delay.y", "out"),
        declared="output out Real m",
        name="inner",
        extra=fixed(0.125),
    )
    outer = component("last", "delay", "input u Real m; output y Real m")
    text = document(system(inner, outer, connections=connection("inner.out", "last.u"), extra=fixed(0.5)), step=None)
    result = fly(pack(tmp_path / "s.ssp", tiny, text), stop_time=2.0)
    assert result.provenance["step"] == 0.125
    ramp = 1.0 + 2.0 * 0.125 * np.arange(17)
    np.testing.assert_array_equal(result["inner.ramp.y"], ramp)
    np.testing.assert_array_equal(result["inner.delay.y"], [5.0, *ramp[:16]])
    read = result["inner.delay.y"][[0, 4, 8, 12]]  # by the outer one, at the start of each of its steps
    np.testing.assert_array_equal(result["last.y"], [*np.repeat([5.0, *read[:3]], 4), read[3]])


def test_loops_fly_under_jacobi(tiny, tmp_path, capsys):
    """Two gains in a ring: 3 times what the other had a step before, from the start that is passed on along it."""
    ring = system(
        component("a", "gain", "input u Real m; output y Real m"),
        component("b", "gain", "input u Real m; output y Real m"),
        connections=connection("a.y", "b.u") + connection("b.y", "a.u"),
    )
    path = pack(tmp_path / "s.ssp", tiny, document(ring))
    with pytest.raises(InputError, match=r"algebraic loop: .*algorithm jacobi"):
        fly(path)
    options = {"algorithm": "jacobi", "open_inputs": "start", "set": {"a.factor": 0.5, "b.factor": -0.5}}
    result = fly(path, **options)
    for of, other, factor in (("a", "b", 0.5), ("b", "a", -0.5)):
        np.testing.assert_array_equal(result[f"{of}.y"][1:], factor * result[f"{other}.y"][:-1])
    assert main(["validate", str(path), "--algorithm", "jacobi"]) == 0
    assert "read one step late" in " ".join(capsys.readouterr().out.split())
