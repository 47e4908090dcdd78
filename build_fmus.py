"""Builds every FMU to build/fmus/FLAVOUR/NAME.fmu and packs every system to build/ssp/SYSTEM.ssp."""

from perilune.fmus_src.export.command import main

if __name__ == "__main__":
    raise SystemExit(main())
