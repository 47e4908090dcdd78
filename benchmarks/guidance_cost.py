"""Instructions and time per plan and per cycle of each descent law: `make guidance-cost` (some minutes).

Each law guides `lunar_landing` for ten seconds; the C source of its FMU, compiled by gcc -O2, is then run with the
recorded inputs. callgrind (valgrind) counts the instructions of the initialisation and of every step. Times are the
shortest of several runs, of the C code and of the Python FMU. The median step is reported as the cycle, and the most
expensive step (the first step, or a later choice of time) as the plan.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import perilune
from perilune.common.errors import InputError
from perilune.common.paths import BUILD, SYSTEMS

CAMPAIGN = SYSTEMS / "lunar_landing" / "campaigns" / "laws_terminal.toml"  # which compares all laws
SECONDS = 10.0
RUNS = 5
DRIVER = Path(__file__).with_name("recorded_steps.c")
TOTAL = re.compile(r"^totals: (\d+)", re.MULTILINE)


@dataclass(frozen=True)
class Recording:
    """Recorded inputs of a guidance: step (s), ``parameters`` by type, and ``inputs`` by name, a row per step."""

    step: float
    parameters: Mapping[str, Mapping[str, float]]
    inputs: Mapping[str, Sequence[float]]
    references: Mapping[str, int]

    def header(self) -> str:
        """Return the C header that `recorded_steps.c` includes."""
        lines = [f"static const double STEP = {self.step!r};"]
        for kind, ctype in (("Real", "double"), ("Integer", "fmi2Integer"), ("Boolean", "fmi2Boolean")):
            names = self.parameters[kind]
            values = [repr(number) if kind == "Real" else str(int(number)) for number in names.values()]
            lines.append(self._references(f"{kind.upper()}S", list(names)))
            lines.append(f"static const {ctype} {kind.upper()}_VALUES[] = {{{', '.join(values)}}};")
        lines.append(self._references("INPUTS", list(self.inputs)))
        rows = (f"{{{', '.join(map(repr, row))}}}" for row in zip(*self.inputs.values(), strict=True))
        lines.append(f"static const double ROWS[][{len(self.inputs)}] = {{{', '.join(rows)}}};")
        return "\n".join(lines)

    def _references(self, name: str, variables: Sequence[str]) -> str:
        numbers = ", ".join(str(self.references[variable]) for variable in variables)
        return f"static const fmi2ValueReference {name}[] = {{{numbers}}};"


def record_guidance(law: str, seconds: float = SECONDS) -> Recording:
    """Simulate `lunar_landing` with a law and return the inputs of its guidance."""
    flight = perilune.simulate("lunar_landing", use={"guidance": law}, stop_time=seconds)
    fmu = flight.prepared.network.fmus["guidance"]
    parameters: dict[str, dict[str, float]] = {"Real": {}, "Integer": {}, "Boolean": {}}
    for (component, name), setting in flight.prepared.settings.variables.items():
        if component == "guidance":
            kind = fmu.variables[name].type
            parameters["Integer" if kind == "Enumeration" else kind][name] = float(setting)
    inputs = {
        name: [float(sample) for sample in flight.signals[f"guidance.{name}"]]
        for name, variable in fmu.variables.items()
        if variable.causality == "input" and variable.type == "Real"
    }
    references = {name: int(variable.reference) for name, variable in fmu.variables.items()}
    return Recording(flight.prepared.step, parameters, inputs, references)


def compile_steps(law: str, recording: Recording, folder: Path) -> Path:
    """Compile the C source of a law's FMU with its recording; return the path of the program."""
    with zipfile.ZipFile(BUILD / "fmus" / "native" / f"{law}.fmu") as fmu:
        fmu.extractall(folder / law)
    sources = folder / law / "sources"
    (folder / "recording.h").write_text(recording.header())
    program = folder / f"{law}.steps"
    names = [f'-DBLOCK="{sources / law}.c"', f'-DRECORDING="{folder / "recording.h"}"']
    command = ["gcc", "-O2", "-std=gnu11", "-g", *names, f"-I{sources}", str(DRIVER), "-o", str(program), "-lm"]
    subprocess.run(command, check=True)
    return program


def count_instructions(program: Path) -> list[int]:
    """Return the number of instructions of each step of a compiled law, counted by callgrind."""
    with tempfile.TemporaryDirectory() as folder:
        options = ["--collect-atstart=no", "--toggle-collect=counted", "--dump-after=counted", "--combine-dumps=no"]
        out = f"--callgrind-out-file={folder}/out"
        subprocess.run(["valgrind", "--tool=callgrind", *options, out, str(program)], check=True, capture_output=True)
        totals = [TOTAL.findall(path.read_text()) for path in Path(folder).iterdir()]
    return [int(total[-1]) for total in totals if total and int(total[-1])]


def time_steps(command: Sequence[str]) -> list[float]:
    """Return the shortest time (us) of each step over several runs of a command that prints the times."""
    runs = [subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.split() for _ in range(RUNS)]
    return [min(map(float, times)) for times in zip(*runs, strict=True)]


def main() -> None:
    for tool in ("gcc", "valgrind"):
        if shutil.which(tool) is None:
            raise InputError("benchmarks.guidance_cost", tool, "not on the path", f"install the package {tool}")
    print("| law | instructions: plan, cycle | C, us: plan, cycle | Python / C: plan, cycle |")
    print("| --- | --- | --- | --- |")
    for law in tomllib.loads(CAMPAIGN.read_text(encoding="utf-8"))["compare"]["guidance"]:
        with tempfile.TemporaryDirectory() as folder:
            recording = record_guidance(law)
            program = compile_steps(law, recording, Path(folder))
            steps, native = count_instructions(program), time_steps([str(program)])
            fmu = BUILD / "fmus" / "python" / f"{law}.fmu"
            stored = Path(folder) / "recording.json"
            stored.write_text(json.dumps(vars(recording)))
            python = time_steps([sys.executable, "-m", "benchmarks.recorded_steps", str(fmu), str(stored)])
        columns = (
            f"{max(steps)}, {median(steps):.0f}",
            f"{max(native):.1f}, {median(native):.2f}",
            f"{max(python) / max(native):.0f}, {median(python) / median(native):.0f}",
        )
        print(f"| `{law}` | {' | '.join(columns)} |", flush=True)


if __name__ == "__main__":
    main()
