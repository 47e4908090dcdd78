"""Fractional-polynomial guidance, shaped by its final thrust, the glide slope and the tilt limit."""

from ..block import Parameter
from ..kernel.enumerations import Enumeration, member
from ..mathlib.lunar.polynomial_descent import DescentShape, is_regular
from .polynomial_guidance import GLIDE_PRICE, SHORTEST, SPACING, TILT_PRICE, PolynomialGuidance

GAINS = 4  # number of values of kr in a search: 6, 8, 10, 12
FIRST_GAIN, GAIN_SPACING = 6.0, 2.0
SEARCH_SHORTEST, SEARCH_SPACING = 0.5, 0.0625  # fractions of the first time


class GainChoice(Enumeration):
    """Origin of the exponents."""

    FIXED = member("gamma and kr from the parameters")
    SEARCHED = member("gamma = 1, kr searched to satisfy the constraints")


class FractionalGuidance(PolynomialGuidance):
    """Fractional-polynomial guidance with two powers of the time to go.

        a = a_f + d_1 t^γ + d_2 t^γ_2    γ_2 = k_r/(γ + 2) - 2

    t is the time to go. The larger k_r above 6, the earlier the thrust acceleration approaches its final value a_f;
    with a_f along z the approach ends upright. With gain_choice 1 a search finds the time and k_r of least propellant,
    with penalties on glide slope and tilt. The status is 3 if γ or γ_2 is negative or both are equal. With
    frozen_time_to_go there is no search, and k_r is 6 instead.

    Assumes constant gravity unless gravity_correction is set.

    Source: Lu 2019 and 2020; the search: this repository.
    """

    last_burn = PolynomialGuidance.last_burn.with_start(
        2.0
    )  # with gamma < 1 the direction's rate is infinite at the end
    final_thrust_acceleration = Parameter(
        [0.0, 0.0, 2.0], unit="m/s2", frame="landing site", description="thrust acceleration at the target"
    )
    gain_choice = Parameter(GainChoice, description="choice of the exponents gamma and kr")
    gamma = Parameter(1.0, unit="1", minimum=0.0, description="first exponent gamma of the time to go")
    kr = Parameter(12.0, unit="1", minimum=0.0, description="gain kr of the position error")

    def shape(self, kr: float) -> DescentShape:
        gamma = self.gamma
        if self.gain_choice == GainChoice.SEARCHED:
            gamma = 1.0
        return DescentShape(final=self.final_thrust_acceleration, gamma=gamma, kr=kr)

    def take_gain(self) -> None:
        if self.gain_choice == GainChoice.FIXED:
            self.flown_kr = self.kr

    def objective(self, time: float, kr: float) -> float:
        """Return the impulse (m/s) with penalties on thrust, glide slope and tilt."""
        cost = self.cost_of(time, kr, self.thrust_margin)
        return cost.objective + GLIDE_PRICE * cost.depth + TILT_PRICE * cost.tilt_excess

    def search_time(self, first: float) -> float:
        """Return the time to go (s) of the least objective by a search from ``first`` (s), and set flown_kr."""
        if self.gain_choice == GainChoice.FIXED:
            self.take_gain()
            if not is_regular(self.shape(self.kr)):
                return 0.0
            return self.best_time(first, SHORTEST, SPACING, self.kr)
        best = 0.0
        minimum = 0.0
        for i in range(GAINS):
            kr = FIRST_GAIN + float(i) * GAIN_SPACING
            time = self.best_time(first, SEARCH_SHORTEST, SEARCH_SPACING, kr)
            price = self.objective(time, kr)
            if i == 0 or price < minimum:
                minimum = price
                best = time
                self.flown_kr = kr
        return best
