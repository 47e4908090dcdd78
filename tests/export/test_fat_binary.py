"""Universal macOS libraries from libraries for one processor each.

Truth: macholib, which reads the combined library; the original libraries. Real libraries are tested in
tests/package/test_wheel.py.
"""

from __future__ import annotations

import io
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from macholib.mach_o import fat_arch, fat_header
from macholib.MachO import MachO

from perilune.fmus_src.export.fat_binary import fat_binary

X86_64, ARM64 = 0x01000007, 0x0100000C  # Apple, mach/machine.h
DYLIB = 6  # mach-o/loader.h


def thin(processor, rest=b"", variant=0):
    """Return a library without load commands: a header and some bytes after it."""
    return struct.pack("<IIIIIIII", 0xFEEDFACF, processor, variant, DYLIB, 0, 0, 0, 0) + rest


@given(st.lists(st.binary(max_size=40_000), min_size=1, max_size=2), st.integers(0, 9))
def test_every_part_is_found_again(rests, variant):
    parts = [thin(processor, remainder, variant) for processor, remainder in zip((X86_64, ARM64), rests, strict=False)]
    joined = fat_binary(parts)
    stream = io.BytesIO(joined)
    assert fat_header.from_fileobj(stream, _endian_=">").nfat_arch == len(parts)
    for part, processor in zip(parts, (X86_64, ARM64), strict=False):
        actual = fat_arch.from_fileobj(stream, _endian_=">")
        assert (actual.cputype, actual.cpusubtype) == (processor, variant)
        assert actual.offset % 2**actual.align == 0
        assert joined[actual.offset : actual.offset + actual.size] == part


def test_macholib_reads_it(tmp_path):
    path = tmp_path / "both.dylib"
    path.write_bytes(fat_binary([thin(X86_64, b"x" * 5), thin(ARM64)]))
    assert [part.header.cputype for part in MachO(str(path)).headers] == [X86_64, ARM64]


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ([thin(X86_64), thin(X86_64)], "two libraries for processor 0x1000007"),
        ([b"\x7fELF" + bytes(60)], "magic number 0x464c457f is not that of a 64-bit Mach-O library"),
    ],
)
def test_what_cannot_be_joined(parts, words):
    with pytest.raises(ValueError, match=words):
        fat_binary(parts)
