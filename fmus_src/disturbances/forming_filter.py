"""Disturbance with a prescribed spectrum: white noise through a second-order filter."""

import math

from ..block import Block, Output, Parameter
from ..interfaces.ports import sampling
from ..kernel.functions import cos, cosh, exp, sin, sinh
from ..mathlib.rng import normal, seed_streams
from ..mathlib.vectors import Vector4, vector


class FormingFilter(Block):
    """Second-order forming filter driven by white noise, discretised exactly.

    With natural_frequency ω_0, damping ζ and white noise n of two-sided spectral density `intensity`:

        y'' + 2 ζ ω_0 y' + ω_0^2 y = ω_0^2 n
        P = diag(v, ω_0^2 v)    v = intensity ω_0/(4 ζ)    Q = P - F P F^T

    The filter starts with a random state of the stationary covariance P. The matrix exponential F and the added
    covariance Q make a step of any length exact.

    Assumes ω_0 h above about 1e-4, below which Q loses its significant digits.

    Source: G. P. Shibanov 2017 (disturbance, without figures); Bar-Shalom, Li and Kirubarajan 2001, section 4.3.
    """

    damping = Parameter(0.5, unit="1", minimum=1e-3, description="damping ratio of the forming filter")
    natural_frequency = Parameter(
        1.0, unit="rad/s", minimum=1e-4, description="undamped natural frequency of the forming filter"
    )
    intensity = Parameter(
        1.0, unit="s", minimum=0.0, description="two-sided spectral density of the white noise that drives the filter"
    )
    seed, stream = sampling.random_stream()
    disturbance = Output(0.0, unit="1", description="disturbance: output of the forming filter")
    disturbance_rate = Output(0.0, unit="1/s", description="time derivative of the disturbance")
    generator = sampling.GENERATOR.state()

    def initialize(self) -> None:
        seed_streams(self.generator, self.seed, self.stream)
        w = self.natural_frequency
        sigma = math.sqrt(self.intensity * w / (4.0 * self.damping))
        first = normal(self.generator)
        second = normal(self.generator)
        self.disturbance = sigma * first
        self.disturbance_rate = w * sigma * second

    def transition(self, h: float) -> Vector4:
        """Return the 2 x 2 matrix exp(A h), row-major, for the state (y, y')."""
        w = self.natural_frequency
        decay = self.damping * w
        square = self.damping * self.damping - 1.0
        e = exp(-decay * h)
        c = e
        s = e * h
        if square < 0.0:
            wd = w * math.sqrt(-square)
            c = e * cos(wd * h)
            s = e * sin(wd * h) / wd
        if square > 0.0:
            wd = w * math.sqrt(square)
            if wd * h < 20.0:
                c = e * cosh(wd * h)
                s = e * sinh(wd * h) / wd
            else:
                # cosh and sinh are equal here, and overflow for larger arguments
                c = 0.5 * exp((wd - decay) * h)
                s = c / wd
        return vector(c + decay * s, s, -w * w * s, c - decay * s)

    def step(self, t: float, h: float) -> None:
        w = self.natural_frequency
        v = self.intensity * w / (4.0 * self.damping)
        f11, f12, f21, f22 = self.transition(h)
        q11 = v - (f11 * f11 + f12 * f12 * w * w) * v
        q12 = -(f11 * f21 + f12 * f22 * w * w) * v
        q22 = w * w * v - (f21 * f21 + f22 * f22 * w * w) * v
        l11 = 0.0
        l21 = 0.0
        if q11 > 0.0:
            l11 = math.sqrt(q11)
            l21 = q12 / l11
        l22 = 0.0
        if q22 > l21 * l21:
            l22 = math.sqrt(q22 - l21 * l21)
        first = normal(self.generator)
        second = normal(self.generator)
        y = self.disturbance
        rate = self.disturbance_rate
        self.disturbance = f11 * y + f12 * rate + l11 * first
        self.disturbance_rate = f21 * y + f22 * rate + l21 * first + l22 * second
