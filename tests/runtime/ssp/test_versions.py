"""SSP 2.0: what SSP 1.0 has too flies as if it said 1.0, what is new is refused by name.

Truth: the same document as SSP 1.0, sample by sample; the release notes of SSP 2.0.
"""

import numpy as np
import pytest

from perilune.analysis.common.errors import InputError
from tests.support.builders import component, connection, document, fly, inline, pack, system

RAMP = component("ramp", "ramp", "output y Real m", inline("start=Real:4 m"))
GAIN = component("gain", "gain", "input u Real m; output y Real m")
TEXT = document(system(RAMP, GAIN, connections=connection("ramp.y", "gain.u")))


def in_version_2(text):
    return text.replace('version="1.0"', 'version="2.0"')


def test_what_both_have_flies(tiny, tmp_path):
    origin = (
        '<ssc:MetaData kind="origin"><ssc:Content><note xmlns="https://example.org">made by hand</note></ssc:Content>'
        "</ssc:MetaData>"
    )
    text = in_version_2(TEXT).replace("<ssd:System ", f"{origin}<ssd:System ", 1)
    assert text.count('version="2.0"') == 2
    one, two = (fly(pack(tmp_path / f"{n}.ssp", tiny, each)) for n, each in enumerate((TEXT, text)))
    assert one["gain.y"][0] == 12.0
    np.testing.assert_array_equal(one["gain.y"], two["gain.y"])


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ('<ssc:Real unit="m"/>', '<ssc:Float64 unit="m"/>', "Float64"),
        ('<ssc:Real unit="m"/>', '<ssc:Real unit="m"/><ssc:Dimension size="3"/>', "Dimension"),
        ('kind="output"', 'kind="structuralParameter"', 'kind="structuralParameter"'),
        ('kind="output"', 'kind="local"', 'kind="local"'),
        ('kind="output"', 'kind="constant"', 'kind="constant"'),
        (
            "<ssd:Component ",
            '<ssd:Component implementation="ScheduledExecution" ',
            'implementation="ScheduledExecution"',
        ),
        ("<ssv:Real", "<ssv:Int32", "Int32"),
    ],
)
def test_what_is_new_is_refused_by_name(tiny, tmp_path, old, new, named):
    text = in_version_2(TEXT).replace(old, new, 1)
    assert text.count(new) == 1
    with pytest.raises(InputError, match=rf"{named} \(line \d+\): is new in SSP 2\.0 and not supported"):
        fly(pack(tmp_path / "s.ssp", tiny, text))


def test_what_neither_has_is_refused(tiny, tmp_path):
    with pytest.raises(InputError, match=r"line \d+: not valid SSP 1\.0: .*'taste' is not allowed"):
        fly(
            pack(
                tmp_path / "s.ssp", tiny, in_version_2(TEXT).replace("<ssd:Component ", '<ssd:Component taste="1" ', 1)
            )
        )
    with pytest.raises(InputError, match=r"version \(line \d+\): SSP version 3\.0 is not read"):
        fly(pack(tmp_path / "s.ssp", tiny, TEXT.replace('version="1.0"', 'version="3.0"')))
