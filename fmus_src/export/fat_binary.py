"""Universal Mach-O libraries: libraries for several processors in one file, of which macOS loads the matching one.

Apple's `lipo` does the same but runs on macOS only. Format: Apple, mach-o/fat.h.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

FAT_MAGIC = 0xCAFEBABE  # everything in the header is big-endian
MACH_O_64 = 0xFEEDFACF  # little-endian, as for all supported processors
ALIGNMENT = 14  # power of 2: the pages of arm64, 16 KiB, a multiple of those of x86_64


def fat_binary(libraries: Sequence[bytes]) -> bytes:
    """Return 64-bit Mach-O libraries for different processors as one file. Raises ValueError for other files."""
    header = struct.pack(">II", FAT_MAGIC, len(libraries))
    body = b""
    processors = set()
    start = len(header) + 20 * len(libraries)
    for library in libraries:
        magic, processor, variant = struct.unpack_from("<III", library)
        if magic != MACH_O_64:
            raise ValueError(f"magic number {magic:#x} is not that of a 64-bit Mach-O library")
        if processor in processors:
            raise ValueError(f"two libraries for processor {processor:#x}; give one per processor")
        processors.add(processor)
        body += bytes(-(start + len(body)) % (1 << ALIGNMENT))
        header += struct.pack(">IIIII", processor, variant, start + len(body), len(library), ALIGNMENT)
        body += library
    return header + body
