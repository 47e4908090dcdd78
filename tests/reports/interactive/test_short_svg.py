"""Paths of SVG are as short as they may be, and go through the same points.

Truth: matplotlib's points; a browser's arithmetic of relative commands, done here with decimal numbers.
"""

from decimal import Decimal

from hypothesis import example, given
from hypothesis import strategies as st

from perilune.analysis.reports.interactive.short_svg import relative_path, shorten
from tests.support.pages.checks import read_path

NUMBERS = st.integers(-99999, 99999).map(lambda hundredths: f"{Decimal(hundredths) / 100:.2f}")
SIZES = {"M": 2, "L": 2, "Q": 4, "C": 6}


def absolute(path):
    """Commands with their points (hundredths) of an absolute path of matplotlib."""
    commands, letter, numbers = [], "", []
    for token in path.split():
        if token.isalpha():
            letter = token
            if letter in "Zz":
                commands.append(("Z", ()))
            continue
        numbers.append(int(Decimal(token) * 100))
        if len(numbers) == SIZES[letter]:
            commands.append((letter, tuple(numbers)))
            numbers = []
    return commands


@st.composite
def paths(draw):
    text = ""
    for letter in ["M", *draw(st.lists(st.sampled_from("MLLLQCZz"), max_size=20))]:
        text += f"{letter} " + " ".join(draw(NUMBERS) for _ in range(SIZES.get(letter, 0))) + " "
    return text


@given(paths())
@example("M 0.00 0.00 L 0.05 -0.05 L 0.10 0.10 Z L 1.00 1.00 ")
def test_the_same_points(path):
    short = relative_path(path)
    assert read_path(short) == absolute(path)


def test_names_that_nothing_refers_to_are_left_out():
    svg = '<g id="a_1">\n<path id="b" d="M 1 2"/>\n <use xlink:href="#b"/></g><text transform="rotate(-0 1 2)">x</text>'
    assert shorten(svg) == '<g><path id="b" d="m1 2"/><use xlink:href="#b"/></g><text>x</text>'


def test_only_paths_of_absolute_commands_are_changed():
    svg = '<svg><path d="M 1 2 \nL 3.005 4 "/><path d="M 1e-5 2"/><path d="m 1 2"/><text> d="M 1 2"</text></svg>'
    assert shorten(svg) == (
        '<svg><path d="m1 2l2 2"/><path d="M 1e-5 2"/><path d="m 1 2"/><text> d="M 1 2"</text></svg>'
    )
