"""Builds every FMU to build/fmus/FLAVOUR/NAME.fmu, composes every system and packs it to build/ssp/SYSTEM.ssp."""

from perilune.analysis.shipped import main

if __name__ == "__main__":
    raise SystemExit(main())
