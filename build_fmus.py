"""Builder of every FMU to build/fmus/FLAVOUR/NAME.fmu, and of every system to build/ssp/SYSTEM.ssp."""

from perilune.analysis.shipped import main

if __name__ == "__main__":
    raise SystemExit(main())
