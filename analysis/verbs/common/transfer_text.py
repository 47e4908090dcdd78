"""Lines that `perilune design transfer` prints of adjoint system, finite switches and the turn in free fall."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from ...design.transfers.hover_study import HoverStudy


def burns_text(burns: Iterable[tuple[float, float]]) -> str:
    """``full thrust 0.0 to 65.6 s, 112.3 to 292.7 s``."""
    return "full thrust " + ", ".join(f"{begin:.1f} to {end:.1f} s" for begin, end in burns)


def adjoint_lines(study: HoverStudy) -> list[str]:
    """Return costates at the start, and the residuals of the conditions; nothing without them."""
    adjoint = study.adjoint
    if adjoint is None:
        return []
    begin, end = adjoint.singular_span
    rms, largest = (math.degrees(angle) for angle in adjoint.tangent_residual)
    first, last = adjoint.reversals
    zeros = ", ".join(f"{time:.1f}" for time in adjoint.switching_times)
    psi = adjoint.costates[0, 0]
    return [
        f"adjoint system: psi1 {psi[0]:.3e}/m, psi2 {psi[1]:.3e} s/m, psi3 {psi[2]:.3e}/m, psi4 {psi[3]:.3e} s/m",
        f"  multipliers before the end: within {_decade(adjoint.mismatch)}",
        f"  tangent law, {begin:.1f} to {end:.1f} s: pitch within {largest:.3f} deg, {rms:.3f} deg rms",
        f"  angular acceleration: {first} reversals before, {last} after",
        f"  psi7 of the wrong sign: below {_decade(adjoint.turning_residual)} of its largest",
        f"  switching function: zero at {zeros} s",
        f"  switching function of the wrong sign: below {_decade(adjoint.switching_residual)} of its largest",
        f"  Hamiltonian: within {_decade(adjoint.hamiltonian_residual)} of the largest switching function",
    ]


def finite_lines(study: HoverStudy) -> list[str]:
    """Return the profile with a finite number of switches, and its cost above the optimum where that is known."""
    profile = study.finite
    if profile is None:
        return []
    t2, t3, t4, t5, t7 = profile.times
    fraction, mass = profile.propellant_fraction, study.vehicle.mass
    lines = [
        f"finite switches: t2 {t2:.2f}, t3 {t3:.2f}, t4 {t4:.2f}, t5 {t5:.2f}, t7 {t7:.2f} s",
        f"  propellant fraction {fraction:.6f}, {fraction * mass:.3f} kg; {burns_text(profile.full_thrust)}",
    ]
    if study.optimum is not None:
        more = fraction - study.optimum.propellant_fraction
        relative = f"{more / study.optimum.propellant_fraction:+.2%}"
        lines.append(f"  {more * mass:+.3f} kg compared with the true optimum ({relative})")
    return lines


def free_fall_lines(study: HoverStudy) -> list[str]:
    """Return the programme that becomes vertical in free fall, and both programmes over distance."""
    plan, mass = study.free_fall, study.vehicle.mass
    if plan is None:
        return []
    t2, t5, w, tp, t7 = plan.times.elements()
    fraction = plan.propellant_fraction
    lines = [
        f"turn in free fall: t2 {t2:.2f}, t5 {t5:.2f}, w {w:.2f}, tp {tp:.2f}, t7 {t7:.2f} s",
        f"  engine off for {plan.fall:.2f} s, then {plan.last_burn:.2f} s of full thrust; {plan.drop:.1f} m lower",
        f"  propellant fraction {fraction:.6f}, {fraction * mass:.3f} kg in {plan.duration:.2f} s",
    ]
    return lines + _table(study)


def _table(study: HoverStudy) -> list[str]:
    if not study.comparisons:
        return []
    rows: list[Sequence[str]] = [("distance, m", "programme, kg", "free fall, kg", "more, kg", "more, %")]
    mass = study.vehicle.mass
    for each in study.comparisons:
        more = each.free_fall - each.programme
        numbers = (mass * each.programme, mass * each.free_fall, mass * more)
        percent = _number(100.0 * more / each.programme, 1)
        rows.append((f"{each.distance:g}", *(_number(value, 3) for value in numbers), percent))
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]


def _decade(value: float) -> str:
    """Return the next power of ten: what lies below the precision of a solver differs from machine to machine."""
    return f"{10.0 ** math.ceil(math.log10(value)):.0e}" if value > 0.0 else "0"


def _number(value: float, digits: int) -> str:
    return "none" if math.isnan(value) else f"{value:.{digits}f}"
