"""`perilune.verify` and `perilune verify`: the evidence inside FMUs and systems, reproduced."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Unpack, overload

from ...common.errors import InputError, suggestion
from ...common.paths import FLAVOURS, names_fmu
from ...common.to_json import to_json
from ...common.visible import first_ones, on_one_line
from ...fmus_src.export.available import find_fmu, fmu_flavours
from ..evidence.comparison import SignalCheck
from ..evidence.reproduction import Reproduction
from ..evidence.verification import Verification, verify_archive
from ..options.declared.library import VERIFY, VerifyOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..reports.common.quantities import number
from ..runtime.ssp.archive import open_system, system_names
from ..runtime.system.options import SystemOptions, Watch, trust_of
from .common.arguments import path_list
from .common.description_text import wrap

VERIFIED, COMPARED, DIFFERENT = "verified", "compared", "different"  # verdicts
NAMED = 6  # signals of an experiment that do not fit


@dataclass(frozen=True)
class Verifications(Sequence[Verification]):
    """What was verified, in the order of the paths."""

    files: tuple[Verification, ...]

    @overload
    def __getitem__(self, index: int) -> Verification: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Verification, ...]: ...
    def __getitem__(self, index: int | slice) -> Verification | tuple[Verification, ...]:
        return self.files[index]

    def __len__(self) -> int:
        return len(self.files)

    def lines(self) -> list[str]:
        """What `perilune verify` prints: each experiment, notes, and which files are as they were handed on."""
        lines = []
        for each in self.files:
            lines += [f"{each.file}: {_summary(made)}" for made in each.reproductions]
            lines += [f"{each.file}: {name}: report reproduced" for name in each.reproduced]
            lines += [line for note in each.notes for line in wrap(f"{each.file}: note: {note}", 4)]
            lines += [f"{each.file}: {_verdict(each)}"] if not _problems(each) else []
        return [on_one_line(line) for line in lines]

    def problems(self) -> list[str]:
        """Problems of all files: not as they were handed on, not reproduced, or compared by too little."""
        return [on_one_line(line) for each in self.files for line in (*_problems(each), *_weaknesses(each))]

    def to_json(self) -> object:
        """All comparisons, for other programs."""
        return to_json(
            [{**asdict(each), "verified": (made := _verdict(each)) == VERIFIED, "verdict": made} for each in self.files]
        )


@verb(VERIFY)
def verify(*paths: FilePath | Sequence[FilePath], **options: Unpack[VerifyOptions]) -> Verifications:
    """Simulate the reference trajectories inside FMUs and systems again, and check their files: `perilune verify`.

    ``paths`` are .fmu and .ssp files with a manifest of FMI-LS-REF, Perilune's or another tool's, or names of FMUs, of
    which ``flavour`` says the build. Signals without a declared tolerance may differ by ``tolerance`` of their greatest
    magnitude: by default 1e-6, and 0, the same bits, in Perilune's own. A tolerance above 1e-2 or fewer than 10 samples
    verify nothing. ``timeout`` (s, wall clock) is of each simulation; the other options say what foreign FMUs may do.
    Raises InputError for a file without evidence, and for an experiment that takes more than a bound permits.
    """
    system = SystemOptions(**trust_of(options).trust)
    watch = Watch(options["timeout"])
    made = [
        verify_archive(
            open_system(_path(path, options["flavour"])), system, relative=options["tolerance"], timeout=watch.timeout
        )
        for path in path_list(paths)
    ]
    return Verifications(tuple(made))


def _path(text: str, flavour: str | None) -> Path:
    """The file that a path or the name of an FMU means. Raises InputError for folders and other files."""
    path = Path(text)
    if names_fmu(path) or path.suffix.lower() == ".ssp":
        return path
    file = find_fmu(text, FLAVOURS if flavour is None else (flavour,))
    if file is not None:
        return file
    is_system = text in system_names() or path.is_dir()
    remedy = f"perilune export {text} writes it with its evidence" if is_system else suggestion(text, fmu_flavours())
    raise InputError("verify", text, "neither an .fmu, an .ssp nor the name of an FMU that is built", remedy)


def _summary(made: Reproduction) -> str:
    compared = (
        f"{made.name}: {made.references.rpartition('/')[2]}: {made.samples} samples of {len(made.signals)} signals"
    )
    if not made.signals:
        return f"{compared}: not compared"
    more = "; reference times lie between communication points: interpolated" if made.interpolated else ""
    more += f"; not numbers, not compared: {', '.join(made.not_compared)}" if made.not_compared else ""
    widest = made.widest
    more = (
        f"; tolerance up to {number(widest.tolerance, 2)} of the greatest magnitude, {widest.name}{more}"
        if widest.tolerance
        else f"; tolerance 0{more}"
    )
    if made.exact:
        return f"{compared}: the same bits{more}"
    worst = made.signals[0]
    if not worst.met:
        return f"{compared}: {sum(not each.met for each in made.signals)} signals differ{more}"
    fraction = f"{number(worst.excess, 2)} of the tolerance"
    return f"{compared}: differ by at most {fraction}, {worst.name} at t = {number(worst.time)} s{more}"


def _verdict(verification: Verification) -> str:
    if _problems(verification):
        return DIFFERENT
    return COMPARED if _weaknesses(verification) else VERIFIED


def _weaknesses(verification: Verification) -> list[str]:
    return [
        f"{verification.file}: {made.name}: compared, not verified: {weakness}"
        for made in verification.reproductions
        for weakness in made.weaknesses
    ]


def _problems(verification: Verification) -> list[str]:
    problems = [f"{verification.file}: {problem}" for problem in verification.problems]
    for made in verification.reproductions:
        where = f"{verification.file}: {made.name}"
        problems += [f"{where}: {problem}" for problem in made.problems]
        wrong = [_difference(each) for each in made.signals if not each.met]
        problems += [f"{where}: {line}" for line in first_ones(wrong, NAMED, "signals")]
    return problems


def _difference(check: SignalCheck) -> str:
    permitted = f"{number(check.permitted, 3)} permitted" if check.permitted else "the same bits required"
    numbers = f"reference {check.reference!r}, simulated {check.actual!r}"
    return (
        f"{check.name} differs by {number(check.difference, 3)} at t = {number(check.time)} s: {numbers}; {permitted}"
    )
