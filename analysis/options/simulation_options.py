"""Options common to all simulations: system, FMUs and parameters; faults, inputs, log and time limit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, TypedDict

from .choices import Algorithm, Flavour, Isolation, LogLevel, OpenInputs
from .fault import Fault
from .option import EMPTY, FilePath, Option, SetValue, StructuredArray


class TrustOptions(TypedDict, total=False):
    """Permissions of foreign FMUs"""

    in_process: Annotated[
        bool, Option("trust foreign FMUs: load them into this process, not into separate ones", False)
    ]
    allow: Annotated[
        Sequence[str],
        Option("let foreign FMUs use the network, or write below a folder", (), metavar="network|write=FOLDER"),
    ]
    isolate: Annotated[
        Isolation,
        Option("restrict foreign FMUs as far as the machine can, or refuse them where it cannot", "available"),
    ]


class LayerOptions(TypedDict, total=False):
    """Composition of a system"""

    use: Annotated[
        Mapping[str, FilePath],
        Option("replace the FMU of a component", EMPTY, metavar="SLOT=FMU", completer="slots_with_fmus"),
    ]
    parameters: Annotated[
        Sequence[FilePath],
        Option("apply a parameter set, by name or path", (), metavar="F.ssv", completer="parameter_sets"),
    ]
    set: Annotated[
        Mapping[str, SetValue],
        Option(
            "set a parameter or an unconnected input, in SI units; in a batch LOW:HIGH:STEP sweeps it",
            EMPTY,
            metavar="COMPONENT.VARIABLE=VALUE",
        ),
    ]


class ScheduleOptions(TypedDict, total=False):
    """Schedule of a system"""

    step: Annotated[float | None, Option("communication step", unit="s", metavar="H")]
    stop_time: Annotated[float | None, Option("end of the simulation", unit="s", metavar="T")]
    algorithm: Annotated[
        Algorithm | None,
        Option("master algorithm (Gauss-Seidel or Jacobi); default: the system's, else sequential"),
    ]
    variant: Annotated[str | None, Option("another SSD of the archive", metavar="NAME")]


class AssemblyOptions(LayerOptions, ScheduleOptions, total=False):
    """Composition and schedule of a system"""


class TreatmentOptions(TypedDict, total=False):
    """Treatment of FMUs and descriptions"""

    flavour: Annotated[
        Flavour | None,
        Option(
            "build of Perilune's FMUs; fused: native ones, the steps of the system compiled as one function; "
            "default: native where built, fused during a batch if that is faster"
        ),
    ]
    allow_unmatched: Annotated[
        bool,
        Option(
            "accept, with a note, errors in parameter sets and mappings: unknown names and units, values given twice",
            False,
        ),
    ]
    strict: Annotated[bool, Option("refuse FMUs whose descriptions violate rules of FMI", False)]
    open_inputs: Annotated[
        OpenInputs | None,
        Option("unconnected inputs: refuse them, or keep their start values; default: refuse; for an FMU alone, start"),
    ]
    feedthrough: Annotated[
        Sequence[str],
        Option("treat all outputs of a component as direct functions of all its inputs", (), metavar="COMPONENT"),
    ]
    no_feedthrough: Annotated[
        Sequence[str], Option("treat a component as without direct feedthrough", (), metavar="COMPONENT")
    ]


class LimitOptions(TypedDict, total=False):
    """Limits of processes with foreign FMUs"""

    call_timeout: Annotated[
        float,
        Option(
            "wall-clock limit of one call of a foreign FMU, including loading and instantiation",
            300.0,
            unit="s",
            metavar="SECONDS",
            above=0.0,
        ),
    ]
    memory: Annotated[
        float,
        Option("memory that a process of foreign FMUs may take", 4.0, unit="GB", metavar="SIZE", above=0.0),
    ]


class ChosenOptions(ScheduleOptions, TreatmentOptions, total=False):
    """Options that distinguish two simulations of one system with equal FMUs and values"""


class SystemKeywords(TrustOptions, AssemblyOptions, TreatmentOptions, LimitOptions, total=False):
    """System options"""


class SimulationOptions(TypedDict, total=False):
    """Simulation options"""

    faults: Annotated[
        Sequence[Fault | str],
        Option(
            "inject a fault, COMPONENT.CONNECTOR=override|bias|freeze[:VALUE]@T[..T], times in s",
            (),
            flag="fault",
            metavar="FAULT",
        ),
    ]
    input: Annotated[
        FilePath | Mapping[str, Any] | StructuredArray | None,
        Option("inputs over time: first column time (s), then inputs by name", metavar="F.csv", completer="csv_files"),
    ]
    log: Annotated[
        LogLevel | None,
        Option(
            "print FMU log messages on standard error: error (discard, error, fatal), warning (also warnings), "
            "info (all messages sent), all (all categories switched on)"
        ),
    ]
    timeout: Annotated[
        float | None,
        Option(
            "wall-clock limit of a simulation, which then ends at its next communication point with exit status 1",
            unit="s",
            metavar="SECONDS",
            above=0.0,
        ),
    ]


class RequireOptions(TypedDict, total=False):
    """Requirements"""

    require: Annotated[
        Sequence[str],
        Option("exit with status 1 unless this expression over the result's numbers is true", (), metavar="EXPRESSION"),
    ]


class JsonFile(TypedDict, total=False):
    """Files"""

    json: Annotated[FilePath | None, Option("write the result as JSON, - for standard output", metavar="FILE")]


class ReportFiles(JsonFile, total=False):
    """Files"""

    report: Annotated[
        FilePath | None, Option("write a page with figures", metavar="F.html", suffixes=(".html", ".htm"))
    ]
    open: Annotated[bool, Option("open the page of --report in a browser", False, needs="report")]


# Groups of options common to several verbs.
Seed = Annotated[int | None, Option("root seed; default: the campaign's", metavar="S")]
Workers = Annotated[int | None, Option("simulations in parallel; default: one per processor", metavar="N")]
Overwrite = Annotated[bool, Option("overwrite existing results in the folder of --output", False)]
UntilDecided = Annotated[bool, Option("stop as soon as the campaign's requirements are met or violated", False)]

SHARED = {"system options": SystemKeywords, "simulation options": SimulationOptions}  # groups explained by --help-all
