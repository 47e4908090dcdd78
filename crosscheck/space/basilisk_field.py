"""The magnetic field in Basilisk, of coefficients that our side hands over. Runs in Basilisk's environment."""

from pathlib import Path

from Basilisk.simulation import magneticFieldWMM

YEAR = 2025.0
DEGREE = 12  # which Basilisk sums
END_OF_FILE = "9" * 48


def world_field(schmidt: list[float], file: Path) -> object:
    """Return the module of the World Magnetic Model with other coefficients g, h (nT), constant in time.

    They are of orders 0 to n for each degree n from 1 on. The file is written; the module reads it when it is reset.
    """
    pairs = iter(zip(schmidt[0::2], schmidt[1::2], strict=True))
    lines = [f"    {YEAR:.1f}            IGRF-14         01/01/2025"]
    for n in range(1, DEGREE + 1):
        for m in range(n + 1):
            g, h = next(pairs)
            lines.append(f"{n:3d}{m:3d} {g:9.1f} {h:9.1f} {0.0:10.1f} {0.0:10.1f}")
    field = magneticFieldWMM.MagneticFieldWMM()
    field.epochDateFractionalYear = YEAR
    file.write_text("\n".join([*lines, END_OF_FILE, END_OF_FILE, ""]), encoding="ascii")
    field.configureWMMFile(str(file))
    return field
