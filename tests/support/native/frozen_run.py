"""Run of a system as C data: the structures of run.h with their arrays, for a program without Python."""

from __future__ import annotations

from typing import Any

import numpy as np

from perilune.analysis.runtime.loop import arrays, codes
from perilune.analysis.runtime.loop.structures import structures

INSTANCE = 1  # stands for the address of the only one


def freeze_run(run: arrays.Run, addresses: list[int]) -> str:
    """Return definitions of a ``run`` of one instance, whose functions are named by their place in ``addresses``."""
    numbers = {address: number for number, address in enumerate(addresses) if address}
    instructions = run.program.instructions.copy()
    calls = instructions[:, codes.INSTANCE] != 0
    instructions[calls, codes.INSTANCE] = INSTANCE
    instructions[calls, codes.ADDRESS] = [numbers[int(address)] for address in instructions[calls, codes.ADDRESS]]
    run = run._replace(program=run.program._replace(instructions=instructions))
    lines: list[str] = []
    body = _members(run, structures()["Run"], "run", lines)
    return "\n".join([*lines, f"static Run run = {body};", ""])


def _members(source: Any, structure: Any, path: str, lines: list[str]) -> str:
    kinds = dict(structure._fields_)
    values = []
    for member in structure.members:
        attribute = getattr(source, member.source)
        name = f"{path}_{member.name}"
        if member.axis is not None:
            text = str(attribute.shape[member.axis])
        elif member.is_structure:
            text = _members(attribute, kinds[member.name], name, lines)
        elif member.dtype is not None:
            text = name
            lines.append(f"static uint64_t {name}[] = {{{_words(attribute)}}};")
        else:
            text = f"{float(attribute).hex()}" if isinstance(attribute, float) else str(int(attribute))
            text = "INFINITY" if text == "inf" else text
        values.append(f".{member.name} = {f'(void *){text}' if text == name else text}")
    return "{" + ", ".join(values) + "}"


def _words(array: np.ndarray) -> str:
    """Return the bytes of an array as words of eight, one at least."""
    content = array.tobytes()
    content += bytes(8 - len(content) % 8)
    return ", ".join(map(hex, np.frombuffer(content, dtype=np.uint64).tolist()))
