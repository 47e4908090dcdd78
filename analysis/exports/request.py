"""Request for `perilune export`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...common.errors import InputError
from ...common.paths import IS_CHECKOUT, Build
from ...common.targets import check_file
from ...fmus_src.export.compilers import PLATFORMS, available_platforms, platforms_of


@dataclass(frozen=True)
class ExportRequest:
    """Request for an export: ``name`` as for `perilune.export`, and versions ``fmi`` and ``ssp`` of the standards.

    Raises InputError for incompatible options.
    """

    name: str
    platforms: Sequence[str]
    flavour: Build | None
    output: Path | None
    fmi: int
    ssp: str | None
    studies: Sequence[str]

    def __post_init__(self) -> None:
        if self.platforms and self.flavour == "python":
            problem = "Python FMUs do not depend on a platform"
            raise InputError("`platforms`", self.platforms[0], problem, "leave out `platforms`")
        if self.fmi == 3 and self.flavour == "python":
            raise InputError("`flavour`", "python", "Python FMUs are FMI 2.0 FMUs", "leave out `flavour` or `fmi`")
        for platform in self.platforms:
            if PLATFORMS[platform].fmi != self.fmi:
                remedy = f"for FMI {self.fmi}.0 give {', '.join(platforms_of(self.fmi))}"
                raise InputError("`platforms`", platform, f"a platform of FMI {PLATFORMS[platform].fmi}.0", remedy)
        check_file("`output`", self.output)

    def check_one_fmu(self) -> None:
        """Reject options that cannot be used for the export of a system as one FMU. Raises InputError."""
        for option, is_chosen in (("flavour", self.flavour == "python"), ("fmi", self.fmi == 3), ("ssp", self.ssp)):
            if is_chosen:
                value = str(getattr(self, option))
                problem = "a system exported as one FMU is an FMI 2.0 FMU compiled from native FMUs"
                raise InputError(f"`{option}`", value, problem, f"leave out `{option}` or `as_fmu`")
        if self.studies:
            problem = "a system exported as one FMU cannot contain reports"
            raise InputError("`studies`", self.studies[0], problem, "leave out `studies` or `as_fmu`")

    def find_platforms(self, *, prebuilt: bool) -> list[str]:
        """Return the requested platforms, by default of the installed package or of the available compilers."""
        if self.platforms:
            return list(self.platforms)
        return platforms_of(2) if prebuilt and self.fmi == 2 and not IS_CHECKOUT else available_platforms(self.fmi)


@dataclass(frozen=True)
class ExportedFiles:
    """Written files, with the flavours and platforms of their FMUs; no platforms if all are Python FMUs."""

    paths: tuple[Path, ...]
    flavours: tuple[str, ...]
    platforms: tuple[str, ...]
