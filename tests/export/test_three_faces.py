"""Every block of the catalogue, integrators and bundles, in three forms: Python object, pythonfmu FMU, native FMU.

Called with the same random admissible values through FMI, all variables agree to the last bit after every step. The
compiled library is compared more extensively in test_native_equals_python.py.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import pytest

from perilune.analysis.runtime.instances.instance import Instance, instantiate
from perilune.analysis.runtime.system.fmu import load_fmu
from perilune.common.paths import shipped_fmu
from perilune.fmus_src.block import Block, Input, Parameter
from perilune.fmus_src.catalogue import catalogue
from perilune.fmus_src.export.native_fmu import build_native_fmu
from perilune.fmus_src.export.pythonfmu_fmu import build_python_fmu
from perilune.fmus_src.runtime import BlockInstance
from tests.support import lengths
from tests.support.kernels.comparison import LONGEST_FLIGHT, bits, draw, elements, only_switches
from tests.support.kernels.native_instance import CACHE
from tests.support.kernels.users_blocks import Bundles, Integrators
from tests.support.lengths import either

BLOCKS = [block for block in catalogue().values() if not block.python_only]
STEPS = lengths.size(1000)
# Two divide a step into hundreds where their drawn time constants are short, the others plan at most steps.
LONG = ("attitude_moon_lander", "spherical_moon_lander", "hover_guidance", "convex_guidance")
STEADY = ("site_divert", "slew_jerk_limited", "slew_step")  # with outputs that change once in a flight, or mostly never
TYPES = ("Real", "Integer", "Boolean")


def by_type(block: type[Block], kinds: tuple[type, ...]) -> dict[str, list[int]]:
    """Return value references of a block's variables of some kinds, by FMI type."""
    actual: dict[str, list[int]] = {name: [] for name in TYPES}
    for reference, (variable, _) in enumerate(elements(block)):
        if isinstance(variable, kinds):
            actual[variable.type_name].append(reference)
    return actual


class Face:
    """One FMU with the interface of Component."""

    def __init__(self, block: type[Block], instance: Instance) -> None:
        self.block = block
        self.slave: Any = instance.slave
        self.everything = by_type(block, (object,))

    def set(self, references: list[int], values: list) -> None:
        for name in TYPES:
            chosen = [(r, v) for r, v in zip(references, values, strict=True) if r in self.everything[name]]
            if chosen:
                getattr(self.slave, f"set{name}")([r for r, _ in chosen], [v for _, v in chosen])

    def values(self) -> list:
        actual: dict[int, Any] = {}
        for name in TYPES:
            references = self.everything[name]
            if references:
                read = getattr(self.slave, f"get{name}")(references)
                convert = bool if name == "Boolean" else (lambda value: value)
                actual |= dict(zip(references, map(convert, read), strict=True))
        return [actual[reference] for reference in sorted(actual)]


def drawn(block: type[Block], kind: type, random: Random, h: float, before: list | None) -> tuple[list[int], list]:
    """Draw references and new values of all variables of a kind."""
    chosen = [
        (r, variable, position) for r, (variable, position) in enumerate(elements(block)) if isinstance(variable, kind)
    ]
    values = [draw(random, variable, position, h, before[r] if before else None) for r, variable, position in chosen]
    return [r for r, _, _ in chosen], values


@pytest.mark.parametrize("block", BLOCKS[:: either(1, 12)], ids=lambda block: block.fmu_name)
@pytest.mark.usefixtures("fmus")
def test_three_faces_agree(block: type[Block]) -> None:
    files = [shipped_fmu(block.fmu_name, flavour) for flavour in ("python", "native")]
    fly_faces(block, files, STEPS if block.fmu_name not in LONG else STEPS // 4)


@pytest.mark.parametrize("block", [Integrators, Bundles])
def test_three_faces_of_a_users_block_agree(block: type[Block], tmp_path: Path) -> None:
    files = [build_python_fmu(block, tmp_path / "python.fmu")]
    files.append(build_native_fmu(block, tmp_path / "native.fmu", platforms=["linux64"], cache=CACHE))
    fly_faces(block, files, STEPS)


def fly_faces(block: type[Block], files: list[Path], required: int) -> None:
    """Compare a block's Python object and FMUs after each of as many steps."""
    instances = [instantiate(load_fmu(file.read_bytes(), str(file)), block.fmu_name) for file in files]
    faces = [Face(block, instance) for instance in instances]
    random = lengths.generator(f"{block.fmu_name} faces")
    rows: set[bytes] = set()
    steps, flights = 0, 0
    while steps < required:
        flights += 1
        h = block.default_step * random.choice([0.5, 1.0])
        plain = BlockInstance(block)
        plain.start_time = random.choice([0.0, 12.5])
        settings = [drawn(block, kind, random, h, None) for kind in (Parameter, Input)]
        for references, values in settings:
            plain.set(references, values)
        for face in faces:
            if steps:
                face.slave.reset()
            for references, values in settings:
                face.set(references, values)
            face.slave.setupExperiment(startTime=plain.start_time)
            face.slave.enterInitializationMode()
            face.slave.exitInitializationMode()
        plain.start()
        now = plain.values()
        latched = 0
        for n in range(LONGEST_FLIGHT):
            references, values = drawn(block, Input, random, h, now)
            t = plain.start_time + n * h
            plain.set(references, values)
            plain.do_step(t, h)
            now = plain.values()
            for face in faces:
                face.set(references, values)
                face.slave.doStep(t, h)
                assert bits(face.values()) == bits(now)
            row = bits(
                [
                    value
                    for value, (variable, _) in zip(now, elements(block), strict=True)
                    if not isinstance(variable, Input | Parameter)
                ]
            )
            latched = latched + 1 if row in rows else 0
            rows.add(row)
            steps += 1
            if latched > 2 or steps >= required:
                break
    for instance in instances:
        instance.free()
    enough = flights - 1 if block.fmu_name in STEADY else 0.5 * required
    assert only_switches(block) or len(rows) > enough, "most rows repeat earlier ones: the comparison says little"
