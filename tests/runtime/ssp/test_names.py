"""Names of signals. Truth: the definition, the longest component followed by a dot that a name begins with."""

from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.runtime.ssp.names import split_name

NAMES = st.text("ab.", max_size=8)


@given(NAMES, st.sets(st.text("ab.", min_size=1, max_size=4)))
def test_a_name_is_split_behind_the_longest_component(name, components):
    owner = max((each for each in components if name.startswith(f"{each}.")), key=len, default=None)
    expected = ("", name) if owner is None else (owner, name.removeprefix(f"{owner}."))
    assert split_name(name, components) == expected
