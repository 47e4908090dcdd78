"""Texts of a stability page on single real poles and on encirclements that cannot be counted.

Truth: a first-order loop with a negative real pole z; a loop with a pole below the lowest frequency, whose encirclement
count is not an integer although its closed loop is stable.
"""

from dataclasses import replace

import numpy as np
import pytest

from perilune.analysis.documents.common.quantities import NONE
from perilune.analysis.documents.of.stability.parts import modes
from perilune.analysis.documents.of.stability.study_cells import omission_text
from perilune.analysis.documents.render.words import cell_text, rich_text
from perilune.analysis.stability.loops.encirclements import encirclements
from perilune.analysis.stability.results.responses import Mode


def mode(z, period=0.1):
    s = complex(np.log(complex(z))) / period
    return Mode(complex(z), s, -s.real / abs(s), abs(s), "loop", 1.0, 1.0)


@pytest.fixture(scope="module")
def loop(studies):
    return studies.late.loops[0]


def test_a_negative_real_pole_is_no_pair(loop):
    part = modes(replace(loop, modes=(mode(0.5 + 0.2j), mode(0.5 - 0.2j), mode(0.3), mode(-0.027))))
    rows = [[cell_text(cell) for cell in row] for row in part.table.rows]
    assert [row[0] for row in rows] == ["0.5 ± 0.2 j", "0.3", "\N{MINUS SIGN}0.027"]
    assert "±" in rows[0][2]
    assert "±" not in rows[1][2] + rows[2][2]
    assert rows[2][2:5] == [NONE, NONE, NONE]
    assert "A real z below 0 is a single pole, not a pair" in part.note
    assert "no pair" not in modes(replace(loop, modes=(mode(0.3),))).note


def test_a_count_that_is_no_whole_number_is_explained(loop):
    """1 + L = (z - 1.1)/(z - 0.9): its gain is flat where its phase still turns, so no slope tells of the pole."""

    def response(frequency):
        return -0.2 / (np.exp(1j * np.asarray(frequency)) - 0.9)

    with pytest.raises(
        ValueError, match="not a whole number of times, since an open-loop pole is slower than"
    ) as caught:
        encirclements(response, 0.05, np.pi)
    uncounted = replace(loop, classical=replace(loop.classical, encirclements=None))
    words = rich_text(omission_text("encirclements", str(caught.value), uncounted))
    assert words.startswith("Encirclements of \N{MINUS SIGN}1 are not counted: between 0.05 and 3.14159 rad/s")
    assert "The verdict does not rest on the count: the closed loop is stable by its poles, largest |z| 0." in words
    assert "0 times" not in words
