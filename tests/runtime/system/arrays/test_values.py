"""Lists of values from parameter sets, through prefixes and mappings, into FMUs and systems; refusals.

Truth: the start values of the FMUs; the rules of SSP 2.0 (row by row, as many values as the dimensions require).
"""

import numpy as np
import pytest

from perilune.common.errors import InputError
from tests.support.arrays.documents import in_version_2
from tests.support.builders import component, connection, document, fly, inline, inline_mapping, pack, system

OUTPUTS = ("three.y[1]", "three.y[2]", "three.y[3]")


def three(bindings=""):
    return component("three", "three", "output y(3) Float64 m", bindings)


def starts(tmp_path, fmus, root, names=OUTPUTS, **options):
    run = fly(pack(tmp_path / "s.ssp", fmus, in_version_2(document(root))), **options)
    return [run[name][0] for name in names]


@pytest.mark.parametrize("given", ["Float64:4,5,6 m", "Real:0.004,0.005,0.006 km", "Int16:4,5,6"])
def test_a_list_of_a_component(array_fmus, tmp_path, given):
    np.testing.assert_allclose(
        starts(tmp_path, array_fmus, system(three(inline(f"start(3)={given}")))), [4.0, 5.0, 6.0], rtol=1e-15
    )


def test_a_matrix_row_by_row(array_fmus, tmp_path):
    grid = component("grid", "grid", "output y(2,3) Float64 m", inline("start(2,3)=Float64:1,2,3,4,5,6 m"))
    names = [f"grid.y[{row},{column}]" for row in (1, 2) for column in (1, 2, 3)]
    assert starts(tmp_path, array_fmus, system(grid), names) == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


def test_of_the_system_with_a_prefix_over_the_component_s(array_fmus, tmp_path):
    root = system(
        three(inline("start(3)=Float64:4,5,6 m")), bindings=inline("start(3)=Float64:7,8,9 m", prefix="three.")
    )
    assert starts(tmp_path, array_fmus, root) == [7.0, 8.0, 9.0]


def test_through_a_mapping_with_a_transformation(array_fmus, tmp_path):
    entry = '<ssm:MappingEntry source="a" target="start"><ssc:LinearTransformation factor="10"/></ssm:MappingEntry>'
    binding = inline("a(3)=Float64:4,5,6 m", mapping=inline_mapping(entry))
    assert starts(tmp_path, array_fmus, system(three(binding))) == [40.0, 50.0, 60.0]


def test_a_parameter_of_the_system_for_all_of_its_readers(array_fmus, tmp_path):
    declared = component("three", "three", "output y(3) Float64 m; parameter start(3) Float64 m")
    root = system(
        declared,
        declared="parameter first(3) Float64 m",
        bindings=inline("first(3)=Float64:4,5,6 m"),
        connections=connection("first", "three.start"),
    )
    assert starts(tmp_path, array_fmus, root) == [4.0, 5.0, 6.0]


@pytest.mark.parametrize("value", ["4,5,6", [4.0, 5.0, 6.0]])
def test_an_option_sets_an_array_of_the_system(array_fmus, tmp_path, value):
    gain = component("gain", "three_gain", "input u(3) Float64 m; output y(3) Float64 m")
    root = system(gain, declared="input in(3) Float64 m", connections=connection("in", "gain.u"))
    names = ("gain.y[1]", "gain.y[2]", "gain.y[3]")
    assert starts(tmp_path, array_fmus, root, names, set={"in": value}) == [8.0, 10.0, 12.0]


def test_enumerations_and_texts_have_an_element_for_each_value(tiny, tmp_path):
    words = '<ssv:String><ssv:Value value="two words"/></ssv:String><ssc:Dimension size="1"/>'
    text = in_version_2(document(system(component("s", "stranger", "parameter word String", inline("word=String:x")))))
    text = text.replace('<ssv:String value="x"/>', words)
    with pytest.raises(InputError, match=r"word\[1\] \(line \d+\): matches no parameter"):
        fly(pack(tmp_path / "s.ssp", tiny, text))
    text = text.replace('<ssc:Dimension size="1"/>', "")
    assert fly(pack(tmp_path / "t.ssp", tiny, text), open_inputs="start")["s.length"][0] == len("two words")


REFUSED = {
    "start(3)=Float64:4,5 m": r"start \(line \d+\): 2 values for the 3 elements of its dimensions",
    "start(2)=Float64:4,5 m": r"start\[1\] \(line \d+\): 2 elements for the 3 of three\.start; give three\.start\[1\]",
    "start(1,3)=Float64:4,5,6 m": r"start\[1,1\] \(line \d+\): 1 x 3 elements for the 3 of three\.start",
    "start(n)=Float64:4 m": r"start, Dimension \(line \d+\): has no size, which only connectors may omit",
    "start(?)=Float64:4 m": r"start, Dimension \(line \d+\): has no size",
    "count(1)=Int32:4": r"count\[1\] \(line \d+\): matches no parameter",
    "start(3)=Boolean:true,true,false": r"start\[1\] .*: the value is of type Boolean, but the variable is of type",
    "start(3)=Float64:4,5,6 s": r"start\[1\] \(line \d+\): unit s cannot be converted to m",
}


@pytest.mark.parametrize("given", REFUSED)
def test_what_does_not_fit_is_refused_in_one_line(array_fmus, tmp_path, given):
    with pytest.raises(InputError, match=REFUSED[given]) as refusal:
        starts(tmp_path, array_fmus, system(three(inline(given))))
    assert "\n" not in refusal.value.text


def test_several_values_need_a_dimension(array_fmus, tmp_path):
    text = in_version_2(document(system(three(inline("start=Float64:4 m"))))).replace('value="4"', 'value="4 5 6"')
    with pytest.raises(InputError, match=r"start \(line \d+\): 3 values for a scalar; give one value for each element"):
        fly(pack(tmp_path / "s.ssp", array_fmus, text))


def test_an_attribute_and_elements_of_values_exclude_each_other(tiny, tmp_path):
    text = in_version_2(document(system(component("s", "stranger", "parameter word String", inline("word=String:x")))))
    text = text.replace('<ssv:String value="x"/>', '<ssv:String value="x"><ssv:Value value="y"/></ssv:String>')
    with pytest.raises(InputError, match=r"word \(line \d+\): has both an attribute value and elements Value"):
        fly(pack(tmp_path / "s.ssp", tiny, text))
