"""Fused benchmark systems give the simulation of Perilune's loop, to the last bit, for any order of components."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from benchmarks.importers.contestant import ExchangeSystem, Unavailable
from benchmarks.importers.contestants import fused_limit
from benchmarks.importers.contestants.loop_and_fmpy import prepare_loop
from perilune.fmus_src.block import Block
from perilune.fmus_src.catalogue import blocks_in_file
from tests.support.builders import component, connection, document, inline, pack, retouched, system


@pytest.fixture
def blocks(tiny_folder: Path) -> dict[str, type[Block]]:
    """Return the blocks of the tiny FMUs by FMU name."""
    return {block.fmu_name: block for block in blocks_in_file(tiny_folder / "tiny_blocks.py")}


def wired(*ends: tuple[str, str]) -> str:
    return "".join(connection(start, end) for start, end in ends)


def course(folder: Path, fmus: Path, *elements: str, connections: str, bindings: str = "") -> ExchangeSystem:
    description = document(system(*elements, connections=connections, bindings=bindings))
    return ExchangeSystem(pack(folder / "test.ssp", fmus / "native", description))


def test_parameters_sources_and_followers(tmp_path: Path, tiny_folder: Path, blocks: dict[str, type[Block]]) -> None:
    flown = course(
        tmp_path,
        tiny_folder,
        component("second", "gain", "input u Real m; output y Real m"),
        component("first-gain", "gain", "input u Real m; output y Real m"),
        component("source", "ramp", "output y Real m"),
        component("careful", "careful", "input u Real m; output y Real m"),
        component("delay", "delay", "input u Real m; output y Real m"),
        connections=wired(
            ("source.y", "first-gain.u"),
            ("first-gain.y", "second.u"),
            ("second.y", "delay.u"),
            ("delay.y", "careful.u"),
        ),
        bindings=inline(
            "source.slope=Real:0.1 m/s; source.flag_at=Integer:3; source.inverted=Boolean:true;"
            " first-gain.factor=Real:-0.7; delay.start=Real:0.3 m"
        ),
    )
    ours, fused = prepare_loop(flown), fused_limit.prepare(flown, blocks)
    for steps in (1, 2, 7, 1, 30):  # each flight restarts
        assert bits(fused(steps)) == bits(ours(steps))
    # the ramp rises from 1 by 0.1 m/s and is read after 2 s
    assert fused(8)["second.y"] == pytest.approx(3.0 * -0.7 * (1.0 + 0.1 * 8 * 0.25))


def test_blocks_that_wait_for_each_other(tmp_path: Path, tiny_folder: Path, blocks: dict[str, type[Block]]) -> None:
    flown = course(
        tmp_path,
        tiny_folder,
        component("left", "cross", "input a Real m; input b Real m; output ya Real m; output yb Real m"),
        component("right", "cross", "input a Real m; input b Real m; output ya Real m; output yb Real m"),
        component("source", "ramp", "output y Real m"),
        component("sink", "delay", "input u Real m"),
        connections=wired(
            ("source.y", "left.a"), ("left.ya", "right.a"), ("right.ya", "left.b"), ("left.yb", "sink.u")
        ),
        bindings=inline("right.b=Real:2 m"),
    )
    assert flown.prepared.schedule.late
    ours, fused = prepare_loop(flown), fused_limit.prepare(flown, blocks)
    for steps in (1, 2, 9):
        assert bits(fused(steps)) == bits(ours(steps))


@pytest.mark.parametrize(
    ("kind", "problem"), [(1, "ZeroDivisionError"), (2, "trouble: an output is not finite"), (4, "ZeroDivisionError")]
)
def test_what_ends_our_flight_ends_a_fused_one(
    tmp_path: Path, tiny_folder: Path, blocks: dict[str, type[Block]], kind: int, problem: str
) -> None:
    flown = course(
        tmp_path,
        tiny_folder,
        component("trouble", "trouble", "output y Real m"),
        component("gain", "gain", "input u Real m; output y Real m"),
        connections=wired(("trouble.y", "gain.u")),
        bindings=inline(f"trouble.kind=Integer:{kind}"),
    )
    with pytest.raises(RuntimeError, match=r"^(failed|nonfinite): "):
        prepare_loop(flown)(5)
    fused = fused_limit.prepare(flown, blocks)
    with pytest.raises(RuntimeError, match=problem):
        fused(5)


def test_a_component_that_is_no_block_is_refused_by_name(tmp_path: Path, tiny_folder: Path) -> None:
    flown = course(
        tmp_path,
        tiny_folder,
        component("source", "ramp", "output y Real m"),
        component("gain", "gain", "input u Real m; output y Real m"),
        connections=wired(("source.y", "gain.u")),
    )
    with pytest.raises(Unavailable, match="source: its FMU ramp is no block of the catalogue"):
        fused_limit.prepare(flown)


def test_an_fmu_of_other_sources_is_refused_by_name(
    tmp_path: Path, tiny_folder: Path, blocks: dict[str, type[Block]]
) -> None:
    """Truth: the GUID, which is a hash of the sources."""
    fmus = tmp_path / "native"
    fmus.mkdir()
    (fmus / "ramp.fmu").write_bytes((tiny_folder / "native" / "ramp.fmu").read_bytes())
    older = re.compile(r'guid="[^"]*"')
    retouched(tiny_folder / "native" / "gain.fmu", fmus / "gain.fmu", lambda text: older.sub('guid="older"', text))
    flown = course(
        tmp_path,
        tmp_path,
        component("source", "ramp", "output y Real m"),
        component("gain", "gain", "input u Real m; output y Real m"),
        connections=wired(("source.y", "gain.u")),
    )
    with pytest.raises(Unavailable, match="gain: its FMU gain is of other sources"):
        fused_limit.prepare(flown, blocks)


def bits(values: dict[str, float]) -> dict[str, str]:
    return {name: value.hex() for name, value in values.items()}
