"""Numbers at the cursor have the same digits as the tables.

Truth: the Python function that writes the tables.
"""

import math
import struct

import numpy as np

from perilune.analysis.documents.common.quantities import number
from tests.support.pages.node import call


def test_as_in_the_tables():
    generator = np.random.default_rng(3)
    numbers = [
        0.0,
        0.5,
        1.0,
        2.5,
        123456.5,
        123457.5,
        999999.5,
        0.0001,
        0.00001234565,
        1e6,
        1e21,
        1e-7,
        math.pi,
        5e-324,
    ]
    numbers += [0.1 * step for step in range(400)] + [float(2**power + 0.5) for power in range(40)]
    numbers += [struct.unpack("<f", struct.pack("<I", bits))[0] for bits in generator.integers(0, 0x7F000000, 2000)]
    numbers += list(10.0 ** generator.uniform(-9, 12, 2000))
    numbers += [-each for each in numbers]
    for digits in (4, 6):
        written = call("page/numbers.ts", "format", [[each, digits] for each in numbers])
        assert written == [number(float(each), digits) for each in numbers]
