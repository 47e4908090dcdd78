"""Coefficients of the capsule's shield. Truth: the published table, digit by digit, and Newton's law by quadrature."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import dblquad

from perilune.fmus_src.mathlib.entry.newtonian_cap import cap_tables, stagnation_coefficient
from perilune.fmus_src.plants.entry_capsule import AXIAL, MACH_NUMBERS, NORMAL


def published(coefficient):
    path = Path(__file__).parents[2] / "papers" / "entry_aerodynamics.csv"
    rows = list(csv.reader(path.open(encoding="utf-8")))[1:]
    return {float(row[1]): [float(value) for value in row[2:]] for row in rows if row[0] == coefficient}


@pytest.mark.parametrize(("coefficient", "declared"), [("Cx", AXIAL), ("Cy", NORMAL)])
def test_the_declared_table_is_the_published_one(coefficient, declared):
    table = published(coefficient)
    assert list(table) == MACH_NUMBERS
    assert declared == [value for row in table.values() for value in row]


def test_the_stagnation_point_behind_a_normal_shock():
    """1.839 as Mach number grows (Anderson 2006, section 3.3), and 1.656 at Mach 2."""
    assert stagnation_coefficient(1e4) == pytest.approx(1.8394, abs=1e-4)
    assert stagnation_coefficient(2.0) == pytest.approx(1.6573, abs=2e-4)


@pytest.mark.parametrize("degrees", [0.0, 20.0, 45.0])
def test_newton_s_law_over_the_cap(degrees):
    """The pressure Cp cos^2 of the angle to the flow, integrated over a cap of unit base area: 1e-5."""
    half, attack = math.asin(1.1 / 2.235), math.radians(degrees)
    flow = np.array([-math.cos(attack), math.sin(attack), 0.0])

    def pressure(component):
        def integrand(around, polar):
            outward = [math.cos(polar), math.sin(polar) * math.cos(around), math.sin(polar) * math.sin(around)]
            facing = -float(np.dot(flow, outward))
            return -(facing**2) * outward[component] * math.sin(polar)

        return dblquad(integrand, 0.0, half, 0.0, 2.0 * math.pi)[0] / (math.pi * math.sin(half) ** 2)

    (axial,), (normal,) = cap_tables(1.1, 2.235, [20.0], [degrees])
    peak = stagnation_coefficient(20.0)
    assert -pressure(0) * peak == pytest.approx(axial, abs=1e-5)
    assert pressure(1) * peak == pytest.approx(normal, abs=1e-5)
