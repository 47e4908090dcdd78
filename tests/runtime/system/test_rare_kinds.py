"""Connectors that are neither input, output nor parameter: local, constant, calculated and structural parameters.

Truth: the behaviour of the FMUs; the table of permitted connections in SSP 2.0.
"""

import numpy as np
import pytest

from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.arrays.documents import in_version_2
from tests.support.builders import component, connection, document, fly, inline, pack, system

COUNTED = component("counted", "counted", "input n Integer; output y Integer")
SETTABLE = component("settable", "counted", "parameter p Integer", inline("n=Integer:0"))


def packed(tmp_path, fmus, *elements, **options):
    return pack(tmp_path / "s.ssp", fmus, in_version_2(document(system(*elements, **options))))


def test_a_local_variable_is_read_like_an_output(array_fmus, tmp_path):
    three = component("three", "three", "local count Integer")
    path = packed(tmp_path, array_fmus, three, COUNTED, connections=connection("three.count", "counted.n"))
    run = fly(path)
    np.testing.assert_array_equal(run["three.count"], [0, 1, 2, 3, 4])
    np.testing.assert_array_equal(run["counted.y"], [0, 1, 2, 3, 4])


def test_a_local_connector_of_a_system_leads_out(array_fmus, tmp_path):
    three = component("three", "three", "local count Integer")
    inner = system(three, name="inner", declared="local c Integer", connections=connection("three.count", "c"))
    path = packed(tmp_path, array_fmus, inner, COUNTED, connections=connection("inner.c", "counted.n"))
    np.testing.assert_array_equal(fly(path)["counted.y"], [0, 1, 2, 3, 4])


@pytest.mark.parametrize(("fmu", "kind"), [("constant", "constant"), ("settled", "calculatedParameter")])
def test_constants_and_calculated_parameters_go_into_inputs(array_fmus, tmp_path, fmu, kind):
    fixed = component("fixed", fmu, f"{kind} y Integer")
    wires = connection("fixed.y", "counted.n") + connection("fixed.y", "out")
    path = packed(tmp_path, array_fmus, fixed, COUNTED, connections=wires, declared=f"{kind} out Integer")
    run = fly(path)
    np.testing.assert_array_equal(run["counted.y"], [7] * 5)
    np.testing.assert_array_equal(run["out"], [7] * 5)


def test_a_constant_goes_into_a_parameter(array_fmus, tmp_path):
    fixed = component("fixed", "constant", "constant y Integer")
    path = packed(tmp_path, array_fmus, fixed, SETTABLE, connections=connection("fixed.y", "settable.p"))
    settings = prepare_system(path, SystemOptions()).settings
    assert settings.variables["settable", "p"] == 7
    assert settings.origins["settable", "p"] == "fixed.y of its FMU"


@pytest.mark.parametrize("kind", ["parameter", "structuralParameter"])
def test_a_parameter_of_a_system_goes_into_inputs_and_outputs(array_fmus, tmp_path, kind):
    inner = system(
        COUNTED,
        name="inner",
        declared=f"{kind} p Integer; output out Integer",
        connections=connection("p", "counted.n") + connection("p", "out"),
        bindings=inline("p=Integer:4"),
    )
    wires = connection("m", "inner.p") + connection("inner.out", "total")
    path = packed(
        tmp_path,
        array_fmus,
        inner,
        connections=wires,
        declared=f"{kind} m Integer; output total Integer",
        bindings=inline("m=Integer:5"),
    )
    for values, expected in (({}, 5), ({"m": 9}, 9)):
        run = fly(path, set=values)
        np.testing.assert_array_equal(run["inner.counted.y"], [expected] * 5)
        np.testing.assert_array_equal(run["total"], [expected] * 5)


def test_a_parameter_with_a_unit_is_converted_on_its_way(array_fmus, tmp_path):
    gain = component("gain", "three_gain", "input u(3) Float64 m; output y(3) Float64 m")
    wires = "".join(connection("p", "gain.u", attributes=f'endIndices="{index}"') for index in (1, 2, 3))
    path = packed(
        tmp_path,
        array_fmus,
        gain,
        connections=wires,
        declared="parameter p Float64 km",
        bindings=inline("p=Float64:3 m"),
    )
    np.testing.assert_allclose(fly(path)["gain.y[2]"], [6.0] * 5, rtol=1e-15)


@pytest.mark.parametrize(
    ("elements", "options", "words"),
    [
        (
            [component("fixed", "settled", "calculatedParameter y Integer"), SETTABLE],
            {"connections": connection("fixed.y", "settable.p")},
            r"connection fixed\.y -> settable\.p \(line \d+\): calculated parameters cannot be connected",
        ),
        (
            [component("fixed", "fixed", "constant y Integer")],
            {},
            r"fixed\.y \(line \d+\): is output in .*, but constant here",
        ),
        (
            [COUNTED],
            {"declared": "parameter p Integer", "connections": connection("p", "counted.n")},
            r"connection p -> counted\.n \(line \d+\): p has no value; give p a value in a parameter set",
        ),
        (
            [component("three", "three", "local count Integer"), SETTABLE],
            {"connections": connection("three.count", "settable.p")},
            r"connects local three\.count with parameter settable\.p; connect parameters with parameters",
        ),
    ],
)
def test_what_cannot_be_passed_on_is_refused_in_one_line(array_fmus, tmp_path, elements, options, words):
    with pytest.raises(InputError, match=words) as refusal:
        prepare_system(packed(tmp_path, array_fmus, *elements, **options), SystemOptions(open_inputs="start"))
    assert "\n" not in refusal.value.text
