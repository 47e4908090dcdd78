"""Adjoint system of a hover transfer, integrated along its optimum, and the residuals of its optimality conditions.

An optimal control minimises H = H_p pt + psi7 alpha - psi4 g + psi1 x' + psi3 y' + psi6 omega, with the switching
function H_p = (psi2 cos th + psi4 sin th) A0/(1 - mu) + psi5 and mu the propellant over the initial mass. Costates are
numbered as in the paper; the fifth belongs to the time at full thrust, c mu/A0. Source: Huang 2017, Hamiltonian,
adjoint system, equations (2) and (3). The final values of the costates are multipliers of the direct method.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..trajectories.vehicle import Transfer, Vehicle
from .true_optimum import OptimalPath

NODES = (1.0 - np.cos(np.pi * np.arange(7) / 6.0)) / 2.0  # nodes as fractions of an interval (Chebyshev)
_POWERS = np.arange(1.0, 8.0)
# Integrals from each node to 1 of the polynomials that are 1 at one node and 0 at the others.
INTEGRALS = (1.0 - NODES[:, np.newaxis] ** _POWERS) / _POWERS @ np.linalg.inv(np.vander(NODES, increasing=True))
FREE = 0.01  # share of the largest angular acceleration, below which it has no sign
IN_ORDER = [0, 1, 2, 3, 6, 4, 5]  # the optimum's states in the paper's order


@dataclass(frozen=True)
class AdjointSolution:
    """Costates along an optimum of N intervals, and the functions of the costates that determine its controls.

    Arrays with a row for each of the N intervals and a column for each node of an interval: ``time`` (s); ``costates``
    psi1 (1/m), psi2 (s/m), psi3 (1/m), psi4 (s/m), psi5 (1/s), psi6 (s), psi7 (s2) along the last axis; ``pitch``
    (rad); ``switching``, H_p (1/s); ``hamiltonian`` (1/s). Arrays with an element for each interval: ``throttle``, 0 at
    its least and 1 at its largest, and ``turning``, the angular acceleration as a fraction of its limit. ``mismatch``
    is the largest difference from the multipliers of the direct method before the end, relative to the largest value of
    each costate.
    """

    time: np.ndarray
    costates: np.ndarray
    pitch: np.ndarray
    switching: np.ndarray
    hamiltonian: np.ndarray
    throttle: np.ndarray
    turning: np.ndarray
    mismatch: float

    @property
    def tangent(self) -> np.ndarray:
        """Pitch (rad) according to the tangent law (2), at the same nodes."""
        return np.arctan2(-self.costates[:, :, 3], -self.costates[:, :, 1])

    @property
    def singular_arc(self) -> slice:
        """Longest run of intervals with an angular acceleration below half its limit, where law (2) should hold."""
        low = np.concatenate([[False], np.abs(self.turning) < 0.5, [False]])
        edges = np.flatnonzero(low[1:] != low[:-1]).reshape(-1, 2)
        first, after = max(edges.tolist(), key=lambda edge: edge[1] - edge[0], default=(0, 0))
        return slice(first, after)

    @property
    def singular_span(self) -> tuple[float, float]:
        """Begin and end (s) of the singular arc; nan if there is none."""
        time = self.time[self.singular_arc]
        return (float(time[0, 0]), float(time[-1, -1])) if time.size else (math.nan, math.nan)

    @property
    def tangent_residual(self) -> tuple[float, float]:
        """Deviation (rad) of pitch from the tangent law on the arc, rms and largest; nan if there is no arc."""
        difference = (self.pitch - self.tangent)[self.singular_arc]
        residual = np.abs(np.arctan2(np.sin(difference), np.cos(difference)))
        return (float(np.sqrt(np.mean(residual**2))), float(residual.max())) if residual.size else (math.nan, math.nan)

    @property
    def switching_times(self) -> list[float]:
        """Zeros (s) of H_p, at which thrust switches."""
        return zeros_of(self.time, self.switching)

    @property
    def switching_residual(self) -> float:
        """Largest interval mean of H_p with a sign that the throttle forbids, over the largest magnitude of H_p."""
        return _largest_forbidden(self.switching, 2.0 * self.throttle - 1.0)

    @property
    def turning_residual(self) -> float:
        """Largest interval mean of psi7 with a sign that the turning forbids, over the largest magnitude of psi7."""
        return _largest_forbidden(self.costates[:, :, 6], self.turning)

    @property
    def hamiltonian_residual(self) -> float:
        """Largest magnitude of H, which should be 0 in free time, over the largest magnitude of H_p."""
        return float(np.abs(self.hamiltonian).max() / np.abs(self.switching).max())

    @property
    def reversals(self) -> tuple[int, int]:
        """Numbers of sign changes of the angular acceleration before the arc and after it."""
        arc = self.singular_arc
        signs = [np.sign(each[np.abs(each) > FREE]) for each in (self.turning[: arc.start], self.turning[arc.stop :])]
        first, last = (int(np.count_nonzero(np.diff(each))) for each in signs)
        return first, last

    def document(self) -> dict[str, object]:
        """Return the solution as JSON, at the interval starts and at the end; angles in deg, otherwise SI units."""
        has_arc = self.time[self.singular_arc].size > 0
        rms, largest = (math.degrees(angle) for angle in self.tangent_residual)
        first, last = self.reversals
        return {
            "time_s": _interval_ends(self.time).tolist(),
            "costates": _interval_ends(self.costates).tolist(),
            "switching_function": _interval_ends(self.switching).tolist(),
            "tangent_law_s": list(self.singular_span) if has_arc else None,
            "tangent_law_deg": {"rms": rms, "largest": largest} if has_arc else None,
            "switching_function_zeros_s": self.switching_times,
            "residuals": {
                "multipliers": self.mismatch,
                "switching_function": self.switching_residual,
                "psi7": self.turning_residual,
                "hamiltonian": self.hamiltonian_residual,
            },
            "reversals": {"before": first, "after": last},
        }


def integrate_adjoint(optimum: OptimalPath, vehicle: Vehicle, transfer: Transfer, engine: float) -> AdjointSolution:
    """Integrate the adjoint system from the end of an optimum to its start.

    ``vehicle`` is the vehicle of the plan, ``engine`` the thrust (N) at full throttle. Over an interval pitch is a
    quadratic and propellant a linear function of time; psi1 to psi4 are linear, and the other costates are integrated
    by quadrature.
    """
    speed, full = vehicle.exhaust_speed, vehicle.full
    span = float(optimum.time[1] - optimum.time[0])
    since = span * NODES
    time = optimum.time[:-1, np.newaxis] + since
    thrust = (optimum.throttle * engine / vehicle.mass)[:, np.newaxis]  # over the initial mass, m/s2
    angle, rate = (column[:-1, np.newaxis] for column in optimum.attitude.T)
    swing = optimum.acceleration[:, np.newaxis]
    pitch = angle + rate * since + swing * since**2 / 2.0
    ratio = 1.0 - optimum.propellant[:-1, np.newaxis] - thrust / speed * since  # ratio of the mass to the initial mass
    lift = thrust * np.sin(pitch) / ratio

    multipliers = optimum.costates[:, IN_ORDER] * np.array([1.0, 1.0, 1.0, 1.0, full / speed, 1.0, 1.0])
    end = multipliers[-1]
    left = time[-1, -1] - time
    psi = np.tile(end, (*time.shape, 1))
    psi[:, :, 1] += end[0] * left
    psi[:, :, 3] += end[2] * left
    along = psi[:, :, 1] * np.cos(pitch) + psi[:, :, 3] * np.sin(pitch)
    across = psi[:, :, 1] * np.sin(pitch) - psi[:, :, 3] * np.cos(pitch)
    psi[:, :, 4] = _integrate_back(end[4], -along * thrust * full / (speed * ratio**2), span)
    psi[:, :, 5] = _integrate_back(end[5], across * thrust / ratio, span)
    psi[:, :, 6] = _integrate_back(end[6], -psi[:, :, 5], span)

    velocity = [_integrate(optimum.velocity[:, 0], thrust * np.cos(pitch) / ratio, span),
                _integrate(optimum.velocity[:, 1], lift - transfer.gravity, span)]  # fmt: skip
    switching = along * full / ratio + psi[:, :, 4]
    hamiltonian = switching * thrust / full + psi[:, :, 6] * swing - psi[:, :, 3] * transfer.gravity
    hamiltonian += psi[:, :, 0] * velocity[0] + psi[:, :, 2] * velocity[1] + psi[:, :, 5] * (rate + swing * since)
    scale = np.abs(multipliers).max(axis=0)
    return AdjointSolution(
        time=time,
        costates=psi,
        pitch=pitch,
        switching=switching,
        hamiltonian=hamiltonian,
        throttle=(thrust[:, 0] - vehicle.least) / (full - vehicle.least),
        turning=optimum.acceleration / vehicle.angular_acceleration,
        mismatch=float(np.max(np.abs(psi[:, -1] - multipliers) / scale)),
    )


def zeros_of(time: np.ndarray, values: np.ndarray) -> list[float]:
    """Return the times at which values cross 0, row by row, with linear interpolation between neighbours."""
    t, v = time.ravel(), values.ravel()
    at = np.flatnonzero((v[1:] > 0.0) != (v[:-1] > 0.0))
    return [float(t[k] - v[k] * (t[k + 1] - t[k]) / (v[k + 1] - v[k])) for k in at]


def _integrate_back(end: float, derivative: np.ndarray, span: float) -> np.ndarray:
    """Return a function at all nodes from its derivative at the nodes and its value at the end of the last interval."""
    to_end = span * derivative @ INTEGRALS.T  # integral from each node to the end of its interval
    later = np.cumsum(to_end[::-1, 0])[::-1] - to_end[:, 0]
    return end - later[:, np.newaxis] - to_end


def _integrate(ends: np.ndarray, derivative: np.ndarray, span: float) -> np.ndarray:
    """Return a function at all nodes from its derivative at the nodes and its values at the ends of all intervals."""
    return ends[1:, np.newaxis] - span * derivative @ INTEGRALS.T


def _interval_ends(rows: np.ndarray) -> np.ndarray:
    """Return the values at the first node of each interval and at the last node of the last interval."""
    return np.concatenate([rows[:, 0], rows[-1:, -1]])


def _largest_forbidden(function: np.ndarray, control: np.ndarray) -> float:
    """Return the largest interval mean of a switching function that its control, from -1 to 1, forbids, as a fraction.

    The denominator is the largest magnitude of the function. A control within 1 % of a limit counts as at the limit,
    where the mean must have the opposite sign; elsewhere the mean must be 0.
    """
    mean = function @ INTEGRALS[0]
    at_limit = np.abs(control) > 1.0 - FREE
    forbidden = np.where(at_limit, np.maximum(mean * np.sign(control), 0.0), np.abs(mean))
    return float(forbidden.max() / np.abs(function).max())
