"""Names of signals. Truth: the component is the longest name, followed by a dot, with which a signal begins."""

import itertools

from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.runtime.ssp.names import elements, split_name

NAMES = st.text("ab.", max_size=8)


@given(NAMES, st.sets(st.text("ab.", min_size=1, max_size=4)))
def test_a_name_is_split_behind_the_longest_component(name, components):
    owner = max((each for each in components if name.startswith(f"{each}.")), key=len, default=None)
    expected = ("", name) if owner is None else (owner, name.removeprefix(f"{owner}."))
    assert split_name(name, components) == expected


@given(st.lists(st.integers(1, 4), min_size=1, max_size=4))
def test_an_array_stands_for_its_elements_in_row_order(shape):
    positions = itertools.product(*(range(1, size + 1) for size in shape))
    names = [f"a.x[{','.join(map(str, position))}]" for position in positions]
    others = {"a.x2[1]", "a.y", "a.x[0]"}
    assert elements("a.x", {*names, *others}) == names
    assert elements("a.x[1", {*names, *others}) == []
    assert elements(names[-1], {*names, *others}) == [names[-1]]
