"""Forming filter, compared with the theory of linear systems driven by white noise.

Truth: the matrix exponential by `scipy.linalg.expm` and the noise covariance by van Loan's method (tolerance 1e-13 of
the stationary covariance; 1e-4 relative at w h = 1e-3, where a difference in the block loses digits), the stationary
covariance by `scipy.linalg.solve_continuous_lyapunov`, and the spectral density |H(f)|^2, with aliases, by
`scipy.signal.welch`. The random numbers of a step are computed in exact integers. Statistics at fixed seeds are within
99.9 % intervals.
"""

import math

import numpy as np
import pytest
from scipy import signal, stats
from scipy.linalg import expm, solve_continuous_lyapunov

from perilune.fmus_src.disturbances.forming_filter import FormingFilter
from tests.support.checks.mrg32k3a import P1, exact_numerator

SHAPES = [(0.05, 3.0), (0.5, 1.0), (0.999999, 2.0), (1.0, 2.0), (1.000001, 2.0), (2.5, 0.4)]
INTENSITY = 0.7


def system(damping, w):
    """Return A and B S B' of the state (y, y')."""
    return np.array([[0.0, 1.0], [-w * w, -2.0 * damping * w]]), np.diag([0.0, INTENSITY * w**4])


def van_loan(damping, w, h):
    """Return the covariance of the noise added over a step: van Loan's over h/64 (exp(-A h)
    stays tame), doubled six times."""
    a, noise = system(damping, w)
    whole = expm(np.block([[-a, noise], [np.zeros((2, 2)), a.T]]) * h / 64.0)
    f = whole[2:, 2:].T
    covariance = f @ whole[:2, 2:]
    for _ in range(6):
        covariance = f @ covariance @ f.T + covariance
        f = f @ f
    return covariance


def filter_of(damping, w, **settings):
    block = FormingFilter(damping=damping, natural_frequency=w, intensity=INTENSITY, **settings)
    block.initialize()
    return block


def two_normals(generator):
    """Return the next two normal numbers of a generator state (MRG32k3a, Box and Muller), in exact integers."""
    state = [int(value) for value in generator]
    uniforms = [exact_numerator(state) / (P1 + 1) for _ in range(4)]
    return [math.sqrt(-2.0 * math.log(u)) * math.cos(2.0 * math.pi * v) for u, v in (uniforms[:2], uniforms[2:])]


def stepped(block, start, h):
    """Return state after a step from ``start``; the generator is put back."""
    generator = list(block.generator)
    block.disturbance, block.disturbance_rate = start
    block.step(0.0, h)
    block.generator = generator
    return np.array([block.disturbance, block.disturbance_rate])


def noise_covariance(damping, w, h):
    """Return covariance that a step adds: its noise is linear in two independent standard normal numbers."""
    added, numbers = [], []
    for seed in (1, 2):
        block = filter_of(damping, w, seed=seed)
        numbers.append(two_normals(block.generator))
        added.append(stepped(block, (0.0, 0.0), h))
    factor = np.transpose(added) @ np.linalg.inv(np.transpose(numbers))
    return factor @ factor.T


@pytest.mark.parametrize(("damping", "w"), SHAPES)
@pytest.mark.parametrize("h", [0.01, 0.1, 1.0, 5.0])
def test_transition_is_the_matrix_exponential(damping, w, h):
    block = filter_of(damping, w)
    noise = stepped(block, (0.0, 0.0), h)
    columns = [(stepped(block, start, h) - noise) / 1e3 for start in ((1e3, 0.0), (0.0, 1e3))]
    scale = np.array([[1.0, 1.0 / w], [w, 1.0]])
    assert np.transpose(columns) / scale == pytest.approx(expm(system(damping, w)[0] * h) / scale, abs=1e-13)


@pytest.mark.parametrize(("damping", "w"), SHAPES)
@pytest.mark.parametrize("h", [0.01, 0.1, 1.0, 5.0])
def test_noise_of_a_step_has_van_loans_covariance(damping, w, h):
    scale = INTENSITY * w / (4.0 * damping) * np.array([[1.0, w], [w, w * w]])
    expected = van_loan(damping, w, h)
    assert noise_covariance(damping, w, h) / scale == pytest.approx(expected / scale, abs=1e-13)


@pytest.mark.parametrize(("damping", "w"), SHAPES)
def test_noise_of_a_short_step_keeps_four_digits(damping, w):
    h = 1e-3 / w
    expected = van_loan(damping, w, h)
    sigma = np.sqrt(expected.diagonal())
    scale = np.outer(sigma, sigma)
    assert noise_covariance(damping, w, h) / scale == pytest.approx(expected / scale, abs=1e-4)


@pytest.mark.parametrize(("damping", "w"), [(0.05, 3.0), (1.0, 2.0), (2.5, 0.4)])
def test_variance_is_stationary_from_the_start_on(damping, w):
    """500 filters at the start and after two unequal steps, each sample within chi-square bounds."""
    count = 500
    blocks = [filter_of(damping, w, seed=3, stream=stream) for stream in range(count)]
    a, noise = system(damping, w)
    covariance = solve_continuous_lyapunov(a, -noise)
    low, high = stats.chi2.ppf([0.0005, 0.9995], 2 * count)
    for t, h in ((0.0, 0.0), (0.0, 0.3), (0.3, 2.0)):
        if h > 0.0:
            for block in blocks:
                block.step(t, h)
        states = np.array([[block.disturbance, block.disturbance_rate] for block in blocks])
        squares = np.einsum("ki,ij,kj->k", states, np.linalg.inv(covariance), states)
        assert low < squares.sum() < high
        assert stats.kstest(states[:, 0] / math.sqrt(covariance[0, 0]), "norm").pvalue > 1e-3
        assert stats.kstest(states[:, 1] / math.sqrt(covariance[1, 1]), "norm").pvalue > 1e-3


@pytest.mark.parametrize(("damping", "w", "h"), [(0.3, 2.0, 0.2), (1.5, 2.0, 0.2)])
def test_spectral_density_is_the_theoretical_one(damping, w, h):
    """Welch's estimate, averaged over bands, within 99.9 % of |H|^2 from f = 0.02 w to half the sampling rate."""
    count, length = 2**15, 2**10
    block = filter_of(damping, w, seed=21)
    samples = np.empty(count)
    for k in range(count):
        block.step(k * h, h)
        samples[k] = block.disturbance
    f, estimate = signal.welch(samples, fs=1.0 / h, nperseg=length, detrend=False)
    aliases = f[:, None] + np.arange(-20, 21) / h
    w_alias = 2.0 * math.pi * aliases
    one_sided = 2.0 * INTENSITY * (w**4 / ((w**2 - w_alias**2) ** 2 + (2.0 * damping * w * w_alias) ** 2)).sum(axis=1)
    ratio = (estimate / one_sided)[3:-1]
    segments = 2 * count // length - 1
    per_band = 16
    bands = ratio[: len(ratio) // per_band * per_band].reshape(-1, per_band).mean(axis=1)
    # Hann window: half-overlapping segments carry 18/19, neighbouring bins 18/35 of independent ones' information
    freedom = 2.0 * segments * 18.0 / 19.0 * per_band * 18.0 / 35.0
    low, high = stats.chi2.ppf([0.0005 / len(bands), 1.0 - 0.0005 / len(bands)], freedom) / freedom
    assert low > 0.75
    assert (bands > low).all()
    assert (bands < high).all()
    assert samples.var() == pytest.approx(INTENSITY * w / (4.0 * damping), rel=0.06)


def test_autocorrelation_across_unequal_steps_is_the_transition():
    """Correlation of start and end over a step of any length, 1000 filters, within 4 standard errors."""
    count, h = 1000, 1.3
    starts, ends = [], []
    for stream in range(count):
        block = filter_of(0.4, 1.5, seed=8, stream=stream)
        starts.append(block.disturbance)
        block.step(0.0, 0.5)
        block.step(0.5, h - 0.5)
        ends.append(block.disturbance)
    expected = expm(system(0.4, 1.5)[0] * h)[0, 0]
    actual = np.mean(np.multiply(starts, ends)) / (INTENSITY * 1.5 / 1.6)
    assert abs(actual - expected) < 4.0 * math.sqrt((1.0 + expected**2) / count)


def test_seeds_and_streams_differ_and_repeat():
    def run(**settings):
        block = filter_of(0.5, 1.0, **settings)
        for k in range(5):
            block.step(0.1 * k, 0.1)
        return block.disturbance

    assert run(seed=1, stream=2) == run(seed=1, stream=2)
    assert len({run(seed=1, stream=2), run(seed=2, stream=2), run(seed=1, stream=3)}) == 3


def test_no_intensity_means_no_disturbance():
    block = FormingFilter(intensity=0.0)
    block.initialize()
    for k in range(5):
        block.step(0.1 * k, 0.1)
        assert (block.disturbance, block.disturbance_rate) == (0.0, 0.0)


def test_disturbance_rate_is_the_derivative():
    """Over short steps the change of y is the mean rate times the step, to second order."""
    block = filter_of(0.5, 1.0)
    h = 0.01
    changes, rates = [], []
    for k in range(2000):
        before, slope = block.disturbance, block.disturbance_rate
        block.step(k * h, h)
        changes.append(block.disturbance - before)
        rates.append(0.5 * (slope + block.disturbance_rate))
    error = np.array(changes) - h * np.array(rates)
    assert abs(error).max() < 6.0 * math.sqrt(INTENSITY * h**3 / 12.0)  # the bridge's variance, w = 1
    assert np.var(error) == pytest.approx(INTENSITY * h**3 / 12.0, rel=0.15)


def test_overdamped_filter_takes_a_step_much_longer_than_its_time_constants():
    block = filter_of(5.0, 1.0)
    block.step(0.0, 200.0)
    assert abs(block.disturbance) < 6.0 * math.sqrt(INTENSITY / 20.0)  # w/(4 damping) of the intensity
