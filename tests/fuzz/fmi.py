"""Native FMUs under the sanitizers: their functions called in any order with any values, as `fmi.c` says."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from perilune.fmus_src.block import Block
from perilune.fmus_src.export.native_fmu import native_sources

GUID = "by hand"
FLAGS = ["-std=c99", "-O1", "-g", "-ffp-contract=off", "-fno-sanitize-recover=all"]
SANITIZERS = "address,undefined,float-divide-by-zero,float-cast-overflow"
LIMITS = ["-timeout=20", "-rss_limit_mb=1000", "-max_len=600", "-len_control=0"]  # s for one input, memory, bytes


def build(block: type[Block], folder: Path, *, guided: bool) -> Path:
    """The program that calls a block's FMU: ``guided`` by libFuzzer, which is clang's, or by random bytes."""
    for name, text in native_sources(block, GUID).items():
        (folder / name).write_bytes(text)
    variables = sum(variable.size for variable in block.variables.values())
    macros = [f'-DGUID="{GUID}"', f"-DSTEP={block.default_step}", f"-DVARIABLES={variables}"]
    if guided:
        compiler = ["clang", f"-fsanitize=fuzzer,{SANITIZERS}"]
    else:
        compiler = ["gcc", f"-fsanitize={SANITIZERS}", "-DSTANDALONE"]
    sources = [Path(__file__).with_name("fmi.c"), f"{block.fmu_name}.c", "-lm"]
    subprocess.run([*compiler, *FLAGS, *macros, "-I.", "-o", "fmi", *sources], cwd=folder, check=True)
    return folder / "fmi"


def fuzz(block: type[Block], folder: Path, runs: int) -> bool:
    """So many inputs; whether all went well. What went wrong is printed, and its input written to the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "corpus").mkdir(parents=True)
    program = build(block, folder, guided=True)
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
