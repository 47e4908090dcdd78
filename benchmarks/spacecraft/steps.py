"""Time of a step of the plant `spacecraft` by degree of the gravity field and by options.

The native FMU is simulated alone, with satellite and orbit of earth_pointing, in communication steps of 0.25 s, each of
which is one fourth-order Runge-Kutta step. The rows take turns in this process, and the shortest simulation counts.
"""

from __future__ import annotations

from perilune.analysis.options.option import SetValue
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import PreparedSystem, prepare_system
from perilune.common.paths import BUILD
from perilune.fmus_src.interfaces.ports.space import Atmosphere

from ..one_fmu import timed

SYSTEM, COMPONENT = "earth_pointing", "satellite"
STEPS, REPEATS, STAGES = 1000, 200, 4
NO_PLATES: dict[str, SetValue] = {f"plates[{row},1]": 0.0 for row in range(1, 13)}
NO_DIPOLE: dict[str, SetValue] = {f"residual_dipole[{axis}]": 0.0 for axis in (1, 2, 3)}
NO_AIR: dict[str, SetValue] = {"atmosphere": int(Atmosphere.VACUUM)}
ALONE: dict[str, SetValue] = {"third_bodies": False}
GRAVITY = NO_PLATES | NO_DIPOLE | NO_AIR | ALONE
# Row: parameter set, and parameters on top of the system's.
ROWS: dict[str, tuple[str | None, dict[str, SetValue]]] = {
    **{f"gravity to degree {n}, nothing else": (None, GRAVITY | {"gravity_degree": n}) for n in (0, 2, 4, 8, 13)},
    "degree 8, Sun and Moon": (None, NO_PLATES | NO_DIPOLE | NO_AIR),
    "degree 8, six plates in light": (None, NO_DIPOLE | NO_AIR | ALONE),
    "degree 8, six plates in light and air": (None, NO_DIPOLE | ALONE),
    "degree 8, dipole in a field to degree 8": (None, NO_PLATES | NO_AIR | ALONE),
    "degree 8, dipole in a field to degree 13": (None, NO_PLATES | NO_AIR | ALONE | {"magnetic_degree": 13}),
    "all of it, as in earth_pointing": (None, {}),
    "all of it, degree 13 of both": (None, {"gravity_degree": 13, "magnetic_degree": 13}),
    "about the Moon, `moon.ssv`": ("moon.ssv", {}),
}


def plant(parameter_set: str | None, parameters: dict[str, SetValue]) -> PreparedSystem:
    """Return the prepared FMU with its parameters in the system and the changes of a row."""
    layers = SystemOptions(parameters=() if parameter_set is None else (parameter_set,))
    system = prepare_system(SYSTEM, layers)
    names = {name for component, name in system.settings.variables if component == COMPONENT}
    bound: dict[str, SetValue] = {name: system.settings.variables[COMPONENT, name] for name in names}
    settings = {f"spacecraft.{name}": number for name, number in (bound | parameters).items()}
    options = SystemOptions(set=settings, step=system.step, stop_time=system.step * STEPS, in_process=True)
    return prepare_system(BUILD / "fmus" / "native" / "spacecraft.fmu", options)


def step_times() -> dict[str, float]:
    """Return the time of a step (us) for each row."""
    flights = {name: timed(plant(*row), STEPS) for name, row in ROWS.items()}
    best = dict.fromkeys(flights, float("inf"))
    for _ in range(REPEATS):
        for name, fly in flights.items():
            best[name] = min(best[name], fly())
    return best
