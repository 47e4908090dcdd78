"""Native FMUs under the sanitizers: their functions called in any order with any values, as `bytes.h` says."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from perilune.fmus_src.block import Block
from perilune.fmus_src.export.description.variables import list_variables
from perilune.fmus_src.export.native_fmu import native_sources

GUID = "by hand"
FLAGS = ["-std=c99", "-O1", "-g", "-ffp-contract=off", "-fno-sanitize-recover=all"]
SANITIZERS = "address,undefined,float-divide-by-zero,float-cast-overflow"
LIMITS = ["-timeout=20", "-rss_limit_mb=1000", "-max_len=600", "-len_control=0"]  # s for one input, memory, bytes


def build(block: type[Block], version: int, folder: Path, *, guided: bool) -> Path:
    """Build the program that calls a block's FMU: ``guided`` by libFuzzer, which is clang's, or by random bytes."""
    for name, text in native_sources(block, GUID, version).items():
        (folder / name).write_bytes(text)
    macros = [f'-DGUID="{GUID}"', f"-DSTEP={block.default_step}", *_variables(block, version)]
    if guided:
        compiler = ["clang", f"-fsanitize=fuzzer,{SANITIZERS}"]
    else:
        compiler = ["gcc", f"-fsanitize={SANITIZERS}", "-DSTANDALONE"]
    sources = [Path(__file__).with_name(f"fmi{version}.c"), f"{block.fmu_name}.c", "-lm"]
    subprocess.run([*compiler, *FLAGS, *macros, "-I.", "-o", "fmi", *sources], cwd=folder, check=True)
    return folder / "fmi"


def _variables(block: type[Block], version: int) -> list[str]:
    """Return the macros that declare the variables."""
    if version == 2:
        return [f"-DREFERENCES={sum(variable.size for variable in block.variables.values())}"]
    variables = list_variables(block)
    types = "".join(variable.type_name[0].lower() for variable in variables) + "f"
    sizes = [*(str(variable.size) for variable in variables), "1"]
    return [f"-DREFERENCES={len(sizes)}", f'-DTYPES="{types}"', f"-DSIZES={','.join(sizes)}"]


def fuzz(block: type[Block], version: int, folder: Path, runs: int) -> bool:
    """Run ``runs`` inputs; return if all went well. A failure is printed, and its input written to the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "corpus").mkdir(parents=True)
    program = build(block, version, folder, guided=True)
    done = subprocess.run(
        [program, f"-runs={runs}", *LIMITS, "-seed=1", "corpus"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        print(f"{block.fmu_name}: {done.stderr[-4000:]}")
    return not done.returncode
