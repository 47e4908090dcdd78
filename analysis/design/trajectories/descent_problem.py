"""Problem of a powered descent in three axes, from numbers by role, for the computation of its bound.

In the frame of the landing site the first two axes are horizontal and the third points up; the Moon's centre is
``moon_radius`` below the origin.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ....common.errors import InputError, suggestion
from ....fmus_src.mathlib.lunar.gravity import STANDARD_GRAVITY
from .point_mass import CentralGravity, PointMassProblem

VECTORS = ("position", "velocity", "target")  # m, m/s, m
SCALARS = ("mass", "specific_impulse", "maximum_thrust", "moon_radius", "gravitational_parameter")  # all positive
OPTIONAL = {"minimum_thrust": 0.0, "glide_offset": 0.0}  # N, m
ANGLES = ("glide_slope", "largest_tilt")  # rad; without them no such limit
SIZES = {name: 3 for name in VECTORS} | dict.fromkeys((*SCALARS, *OPTIONAL, *ANGLES), 1)
REMEDY = "correct the inputs of the bound"


def check_roles(sizes: Mapping[str, int], where: tuple[str, str]) -> None:
    """Reject ``sizes``, the count of numbers by role, unless they match a descent. Raises InputError."""
    file, element = where
    for name, size in sizes.items():
        if name not in SIZES:
            raise InputError(file, f"{element}.{name}", "not an input of a bound", suggestion(name, SIZES))
        if size != SIZES[name]:
            raise InputError(file, f"{element}.{name}", f"{size} numbers, not {SIZES[name]}", REMEDY)
    for name in (*VECTORS, *SCALARS):
        if name not in sizes:
            raise InputError(file, element, f"no {name}", f"add {name} = ...")


def descent_problem(inputs: Mapping[str, Sequence[float]], where: tuple[str, str]) -> tuple[PointMassProblem, float]:
    """Return the problem of a descent to rest at the target, and its initial mass (kg).

    ``inputs`` contains numbers in SI units, by the names in `SIZES`, already checked by `check_roles`; ``where`` (file,
    element) is named in errors. Raises InputError.
    """
    file, element = where
    number = {name: OPTIONAL.get(name, math.nan) for name in SIZES if SIZES[name] == 1}
    number |= {name: values[0] for name, values in inputs.items() if len(values) == 1}
    for name in SCALARS:
        if not number[name] > 0.0:
            raise InputError(file, f"{element}.{name}", f"{number[name]:g} is not positive", REMEDY)
    for name in ANGLES:
        if name in inputs and not 0.0 < number[name] < math.pi / (2 if name == "glide_slope" else 1):
            raise InputError(file, f"{element}.{name}", f"{number[name]:g} rad is not a valid angle", REMEDY)
    if not 0.0 <= number["minimum_thrust"] < number["maximum_thrust"]:
        problem = f"{number['minimum_thrust']:g} N is negative, or not below the largest thrust"
        raise InputError(file, f"{element}.minimum_thrust", problem, REMEDY)
    position, velocity, target = (tuple(map(float, inputs[name])) for name in VECTORS)
    distance, full = math.dist(position, target), number["maximum_thrust"] / number["mass"]
    if not distance > 0.0:
        raise InputError(file, f"{element}.target", "is the start of the descent itself", REMEDY)
    descent = PointMassProblem(
        start_position=position,
        start_velocity=velocity,
        end_position=target,
        end_velocity=(0.0, 0.0, 0.0),
        gravity=CentralGravity(number["gravitational_parameter"], number["moon_radius"]),
        exhaust_speed=number["specific_impulse"] * STANDARD_GRAVITY,
        least=number["minimum_thrust"] / number["mass"],
        most=full,
        length=distance,
        speed=math.sqrt(distance * full),
        largest_tilt=number["largest_tilt"] if "largest_tilt" in inputs else None,
        glide_slope=number["glide_slope"] if "glide_slope" in inputs else None,
        glide_offset=number["glide_offset"],
    )
    return descent, number["mass"]
