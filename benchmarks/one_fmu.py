"""Time per step of systems in several forms: `python -m benchmarks.one_fmu [SYSTEM ...]`, after build_fmus.py.

One loop simulates all forms in this process: the system from its FMUs (native), with steps compiled as one function
(fused), as the FMU of `perilune export --as-fmu`, and as the container FMU that the FMU Manipulation Toolbox builds
from the .ssp. The forms take turns, and the shortest simulation counts. The toolbox ignores parameter sets, so its
systems have different parameters.
"""

from __future__ import annotations

import argparse
import logging
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import perilune
from perilune.analysis.exports.system_fmu.build import build_system_fmu
from perilune.analysis.exports.system_fmu.one_fmu import OneFmu
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.ssp.archive import open_system, system_names
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import PreparedSystem, prepare_system
from perilune.common.paths import BUILD, SYSTEMS
from perilune.fmus_src.export.compilers import local_platform
from perilune.fmus_src.export.ssp_package import pack_system

STEPS = 2000
REPEATS = 7


def one_fmu(name: str, folder: Path) -> PreparedSystem:
    """Return the prepared system as one FMU, to be simulated alone."""
    path = folder / f"{name}.fmu"
    platform = local_platform()
    assert platform is not None
    request = OneFmu({}, (), (), SystemOptions(flavour="native"))
    build_system_fmu(open_system(name), path, request, [platform], portable=False)
    print(f"{name}: one FMU of {path.stat().st_size / 1e3:.0f} kB")
    return prepare_system(path)


def container(name: str, folder: Path) -> PreparedSystem | None:
    """Return a prepared container FMU of the toolbox; None if the toolbox cannot build it."""
    from fmu_manipulation_toolbox.assembly import Assembly

    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.CRITICAL)
    pack_system(SYSTEMS / name, [BUILD / "fmus" / "native"], folder / "packed")
    step = prepare_system(name).step
    try:
        assembly = Assembly("packed.ssp", fmu_directory=_with_system(folder, name), default_step_size=step)
        assembly.root.sequential = True
        assembly.make_fmu()
        path = folder / "packed.fmu"
        print(f"{name}: container of {path.stat().st_size / 1e3:.0f} kB")
        return prepare_system(path, SystemOptions(in_process=True, step=step, stop_time=1.0, open_inputs="start"))
    except Exception as error:  # the toolbox raises many kinds of exceptions
        print(f"{name}: no container: {type(error).__name__}: {str(error)[:200]}")
        return None


def _with_system(folder: Path, name: str) -> Path:
    (folder / "packed" / f"{name}.ssp").rename(folder / "packed.ssp")
    return folder


def timed(prepared: PreparedSystem, steps: int) -> Callable[[], float]:
    """Return a function that simulates ``steps`` steps and returns the time per step (us)."""
    simulation = Simulation(prepared, requested=())

    def fly() -> float:
        simulation.advance(-1, 0, every=steps)
        begun = time.perf_counter()
        simulation.advance(0, steps, every=steps)
        return 1e6 * (time.perf_counter() - begun) / steps

    return fly


def main() -> None:
    """Print a row for each system."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("systems", nargs="*", default=system_names())
    for name in parser.parse_args().systems:
        with tempfile.TemporaryDirectory() as text:
            folder = Path(text)
            forms = {
                "native": prepare_system(name, SystemOptions(flavour="native")),
                "fused": prepare_system(name, SystemOptions(flavour="fused")),
                "one FMU": one_fmu(name, folder),
                "container": container(name, folder),
            }
            steps = min(STEPS, perilune.simulate(name).time.size - 2)  # until its end, after which one FMU does nothing
            flights = {form: timed(prepared, steps) for form, prepared in forms.items() if prepared is not None}
            best = dict.fromkeys(flights, float("inf"))
            for _ in range(REPEATS):
                for form, fly in flights.items():
                    best[form] = min(best[form], fly())
        row = "  ".join(f"{form} {us:.3f} us ({us / best['native']:.2f})" for form, us in best.items())
        print(f"{name:24} {row}", flush=True)


if __name__ == "__main__":
    main()
