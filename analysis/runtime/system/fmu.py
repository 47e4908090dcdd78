"""FMU file that has been checked and unpacked, with its variables, units and dependencies."""

from __future__ import annotations

import hashlib
import io
import shutil
import weakref
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

import fmpy
from fmpy import read_model_description
from fmpy.model_description import ModelDescription, ValidationError
from lxml import etree

from ....common.errors import InputError
from ....common.machine.os_errors import is_of_machine, reason_of, remedy_of
from ....common.scratch import make_folder
from ....common.zips import REMEDY, UNREADABLE, open_zip, read_entry
from ....fmus_src.own_digests import is_own
from ..fmi import model_description as fmi3
from ..fmi.quantities import complete_quantities
from ..fmi.variable import ScalarVariable, elements_of, variables_of
from ..ssp.conversions import Unit, units_of_fmu
from ..ssp.documents import parse_xml
from ..ssp.fmu_description import DESCRIPTION, check_description, check_rules, external_state_of

MOST_FLAWS = 3  # most flaws named in one line
MOST_DESCRIPTIONS = 32  # most descriptions in the cache
SOURCES = "sources/"
STRUCTURAL = "structuralParameter"
NOT_VARIED = ("a structural parameter, which sizes arrays, cannot vary from trial to trial", "set it with `set`")


@dataclass
class Fmu:
    """Co-simulation FMU of FMI 2.0 or 3.0 for this platform."""

    label: str
    digest: str
    description: ModelDescription
    folder: Path  # unpacked FMU; removed with this object
    variables: dict[str, ScalarVariable] = field(default_factory=dict)
    units: dict[str, Unit] = field(default_factory=dict)
    is_own: bool = False  # built by Perilune
    external_state: tuple[str, ...] = ()  # names of a block's objects that its FMU state does not contain
    flaws: list[str] = field(default_factory=list)  # rules of FMI that its description breaks, though it is readable
    sizes: Mapping[str, int] = field(default_factory=dict)  # structural parameters with other than declared values
    origin: Fmu | None = None  # the loaded FMU, if this one has other sizes
    content: bytes = field(default=b"", repr=False, compare=False)  # content of the file, if Perilune built it

    @property
    def name(self) -> str:
        return self.description.modelName

    @property
    def printers(self) -> list[str]:
        """Name of the FMU; see `PreparedSystem.printers`."""
        return [self.name]

    @property
    def version(self) -> int:
        """Version of FMI, 2 or 3."""
        return int(self.description.fmiMajorVersion)

    @property
    def binary(self) -> str:
        """Path of the library for this platform inside the FMU."""
        return _binary(self.description)

    @property
    def is_alone(self) -> bool:
        """True if a process can have only one instance of the FMU."""
        return bool(self.description.coSimulation.canBeInstantiatedOnlyOncePerProcess)

    @property
    def is_self_contained(self) -> bool:
        """True if its reset and its errors leave no trace, so that it may be simulated in this process."""
        return self.is_own and not self.external_state

    @property
    def is_native(self) -> bool:
        """True if it runs without an execution tool such as a Python interpreter."""
        return not self.description.coSimulation.needsExecutionTool

    @property
    def structural_parameters(self) -> list[str]:
        """Parameters of FMI 3.0 that determine array sizes, or that are set in configuration mode."""
        return [name for name, variable in self.variables.items() if variable.causality == STRUCTURAL]

    def unit_of(self, variable: ScalarVariable) -> Unit | None:
        """Return the unit of a variable, or None if it has no unit or the FMU does not define the unit."""
        unit = self.units.get(variable.unit or "")
        return unit if unit is None else replace(unit, is_relative=variable.is_relative)

    def with_sizes(self, sizes: Mapping[str, int]) -> Fmu:
        """Return the FMU with these values of structural parameters, and arrays of the resulting sizes."""
        loaded = self.origin or self
        if sizes == self.sizes:
            return self
        by_reference = {self.variables[name].reference: size for name, size in sizes.items()}
        fmi3.check_sizes(self.description, by_reference, self.label)
        variables = elements_of(self.description.modelVariables, by_reference)
        return replace(loaded, variables=variables, sizes=dict(sizes), origin=loaded)

    def read_sources(self) -> dict[str, str]:
        """Return the C code of an FMU built by Perilune, by file name. Raises InputError if the FMU is damaged."""
        archive = open_zip(self.content, self.label)
        files = [name for name in archive.namelist() if name.startswith(SOURCES) and name.endswith((".c", ".h"))]
        return {name.removeprefix(SOURCES): read_entry(archive, name, self.label).decode() for name in files}

    def read_dependencies(self) -> dict[str, set[str] | None]:
        """Return, for each output, the inputs on which it depends directly according to ModelStructure.

        The value is None for an output without declared dependencies.
        """
        inputs = {name for name, variable in self.variables.items() if variable.causality == "input"}
        outputs: dict[str, set[str] | None] = {
            name: None for name, variable in self.variables.items() if variable.causality == "output"
        }
        if self.version == 2:
            for unknown in self.description.outputs:
                if unknown.dependencies is not None:
                    outputs[unknown.variable.name] = inputs & {variable.name for variable in unknown.dependencies}
            return outputs
        named: dict[int, list[str]] = {}  # elements and aliases; a dependency on one element counts as one on all
        for name, variable in self.variables.items():
            named.setdefault(variable.reference, []).append(name)
        for unknown in self.description.outputs:
            if unknown.dependencies is not None:
                known = {name for each in unknown.dependencies for name in named.get(each.valueReference, ())}
                outputs |= dict.fromkeys(named.get(unknown.variable.valueReference, ()), inputs & known)
        return outputs


def load_fmu(data: bytes, label: str, *, strict: bool = False) -> Fmu:
    """Check and unpack an FMU; if ``strict``, reject an FMU with flaws. Raises InputError with file and element."""
    archive = open_zip(data, label)
    if DESCRIPTION not in archive.namelist():
        raise InputError(label, DESCRIPTION, "not found", "give an FMU")
    xml = read_entry(archive, DESCRIPTION, label)
    root = parse_xml(xml, f"{label}!{DESCRIPTION}")
    is_fmi3 = fmi3.is_fmi3(root.get("fmiVersion"))
    (fmi3.check_description if is_fmi3 else check_description)(root, label)
    check_rules(xml, 3 if is_fmi3 else 2, label)
    description, flaws = _read_description(xml)
    if description is None:
        raise InputError(label, DESCRIPTION, f"not valid: {_some(flaws)}", "fix the FMU")
    if flaws and strict:
        raise InputError(label, DESCRIPTION, f"not valid: {_some(flaws)}", "fix the FMU, or simulate without `strict`")
    if description.coSimulation is None:
        raise InputError(label, "CoSimulation", "not a co-simulation FMU", "export the FMU for co-simulation")
    if not is_fmi3 and fmpy.architecture == "aarch64" and fmpy.system != "darwin":
        problem = f"FMI 2.0 does not define the platform {fmpy.platform_tuple}, so no FMU has a binary for it"
        raise InputError(label, "binaries", problem, "use an x86_64 machine or macOS")
    binary = _binary(description)
    if binary not in archive.namelist():
        has_sources = any(name.startswith("sources/") and name.endswith(".c") for name in archive.namelist())
        remedy = "compile the FMU's sources for this platform" if has_sources else "export the FMU for this platform"
        if description.coSimulation.needsExecutionTool:
            remedy = "use its native flavour"
        raise InputError(label, binary, "no binary for this platform", remedy)
    folder = make_folder()
    digest = hashlib.sha256(data).hexdigest()
    external = external_state_of(xml)
    fmu = Fmu(label, digest, description, folder, is_own=is_own(digest), external_state=external, flaws=list(flaws))
    if fmu.is_own:
        fmu.content = data
    # Others' may reach for any of their files: FMPy's remoting starts a server of binaries/win32 from binaries/win64.
    read_here = (DESCRIPTION, f"{Path(binary).parent.as_posix()}/", "resources/")
    names = [name for name in archive.namelist() if name.startswith(read_here) or not fmu.is_own]
    try:
        archive.extractall(folder, names)
    except UNREADABLE as error:
        if isinstance(error, OSError) and is_of_machine(error):
            problem = f"cannot be unpacked to {folder}: {reason_of(error)}"
            raise InputError(label, "archive", problem, remedy_of(error)) from error
        raise InputError(label, "archive", f"cannot be unpacked, probably damaged: {error}", REMEDY) from error
    if is_fmi3:
        fmi3.check_sizes(description, {}, label)
    fmu.variables = dict(_read_variables(xml))
    fmu.units = units_of_fmu(description, label)
    weakref.finalize(fmu, shutil.rmtree, folder, ignore_errors=True)
    return fmu


@lru_cache(maxsize=MOST_DESCRIPTIONS)
def _read_description(xml: bytes) -> tuple[ModelDescription | None, tuple[str, ...]]:
    """Return an FMU's modelDescription.xml, or None if it is unreadable, and the rules that it violates.

    Reading the description takes most of the time of loading an FMU. The result is never modified, and is reused when a
    system is prepared again.
    """
    try:
        return _complete(read_model_description(_open_zip(xml), validate=True), xml), ()
    except ValidationError as error:
        flaws = tuple(" ".join(problem.split()) for problem in error.problems)
    except Exception as error:  # FMPy raises bare Exception and lxml's errors; other errors are programming errors
        kind = "" if type(error) is Exception or isinstance(error, etree.LxmlError) else f"{type(error).__name__}: "
        flaws = (f"FMPy cannot read it: {kind}{' '.join(str(error).split())}",)
    try:
        return _complete(read_model_description(_open_zip(_with_fixed_parameters(xml)), validate=False), xml), flaws
    except Exception:
        return None, flaws


def _complete(description: ModelDescription, xml: bytes) -> ModelDescription:
    root = parse_xml(xml, DESCRIPTION)
    complete_quantities(description, root)
    if description.fmiMajorVersion == 3:
        fmi3.complete(description, root)
    return description


@lru_cache(maxsize=MOST_DESCRIPTIONS)
def _read_variables(xml: bytes) -> Mapping[str, ScalarVariable]:
    """Return the variables of a description by name, with declared array sizes."""
    description, _ = _read_description(xml)
    assert description is not None
    return variables_of(description)


def _binary(description: ModelDescription) -> str:
    """Return the path of the library for this platform inside the FMU."""
    platform = fmpy.platform_tuple if description.fmiMajorVersion == 3 else fmpy.platform
    return f"binaries/{platform}/{description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"


def _with_fixed_parameters(xml: bytes) -> bytes:
    """Return the description with varying parameters, as pythonfmu writes them, declared as fixed.

    FMPy would reject varying parameters, and these are only set before a simulation.
    """
    root = parse_xml(xml, DESCRIPTION)
    for variable in root.iterfind("ModelVariables/ScalarVariable[@causality='parameter']"):
        if variable.get("variability", "continuous") not in ("fixed", "tunable"):
            variable.set("variability", "fixed")
    return etree.tostring(root)


def _open_zip(xml: bytes) -> io.BytesIO:
    """Return an archive in memory that contains only the description, from which FMPy can read it."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr(DESCRIPTION, xml)
    content.seek(0)
    return content


def _some(flaws: Sequence[str]) -> str:
    more = f"; and {len(flaws) - MOST_FLAWS} more" if len(flaws) > MOST_FLAWS else ""
    return "; ".join(flaws[:MOST_FLAWS]) + more
