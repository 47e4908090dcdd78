"""FMU of a block that runs its Python source, built with pythonfmu."""

from __future__ import annotations

import inspect
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path

from pythonfmu import FmuBuilder

from ..block import Block
from ..catalogue import is_shipped
from ..evidence.block import add_evidence
from ..own_digests import note_own
from .archive import content_guid, read_zip, write_zip
from .attributes import check_attributes
from .closure import Closure, ClosureError, closure_of
from .description.fmi2 import model_description
from .description.origin import accompanying_files, origin
from .judge.tunable import tunable_parameters

SCRIPT = '''"""FMU script of {fmu_name}, generated; the block is in {package}/{block_path}."""

import sys

# pythonfmu releases the module's dict once too often at each instantiation: keep one more reference.
sys.__dict__.setdefault("_perilune_scripts", []).append(globals())

from {package}.export.pythonfmu_slave import BlockSlave
from {package}.{block_module} import {class_name}


class {script_class}(BlockSlave):
    block_class = {class_name}
    tunable = {tunable}
'''


def build_python_fmu(block_class: type[Block], path: Path) -> Path:
    """Build the pythonfmu FMU of a block at ``path``; two builds are byte-identical.

    The FMU contains the block's import closure under a package name with the hash of its content. To run, it needs
    Python and the block's ``requires``. Raises `ClosureError` and `UndeclaredError`.
    """
    check_attributes(block_class)
    closure = closure_of(block_class)
    script_name = f"{block_class.fmu_name}_{closure.digest[:16]}"
    script = SCRIPT.format(
        fmu_name=block_class.fmu_name,
        package=closure.package,
        block_path=f"{closure.block_module.replace('.', '/')}.py",
        block_module=closure.block_module,
        class_name=block_class.__name__,
        tunable=tuple(tunable_parameters(block_class)),
        script_class=f"{block_class.__name__}Slave",
    )
    is_ours = is_shipped(block_class)
    try:
        files = _with_pythonfmu(closure, script_name, script)
    except Exception as error:  # an exception of the user's file is reported as one line
        if is_ours:
            raise
        failed = f"importing it as it is packed into the FMU failed: {type(error).__name__}: {error}"
        remedy = "name the files that it reads in `data` of the block, and read them in `initialize`"
        raise ClosureError(f"{inspect.getfile(block_class)}: {failed}; {remedy}") from error
    files |= accompanying_files(2, is_ours=is_ours, runs_python=True)
    tool = f"Perilune {version('perilune')} with PythonFMU {version('pythonfmu')}"

    def describe(guid: str) -> bytes:
        about = origin(tool, is_ours=is_ours, is_final=guid != "")
        return model_description(block_class, guid=guid, origin=about, needs_execution_tool=True)

    files["modelDescription.xml"] = describe("")
    files["modelDescription.xml"] = describe(content_guid(files))
    write_zip(path, add_evidence(block_class, files))
    note_own(path)
    return path


def _with_pythonfmu(closure: Closure, script_name: str, script: str) -> dict[str, bytes]:
    """Return the files of the FMU that pythonfmu's builder creates from script and closure.

    The builder imports the script; sys.path and sys.modules are restored afterwards. Its zip contains dates, so only
    the content is used.
    """
    path_before = list(sys.path)
    modules_before = set(sys.modules)
    retained: list = sys.__dict__.setdefault("_perilune_scripts", [])
    scripts_before = len(retained)
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder) / "script"
        script_file = work / f"{script_name}.py"
        script_file.parent.mkdir()
        script_file.write_text(script, encoding="utf-8")
        for name, text in closure.pack_closure().items():
            target = work / name
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(text)
        sys.path.insert(0, str(work))
        write_bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
        try:
            built = FmuBuilder.build_FMU(script_file, Path(folder) / "out.fmu", [work / closure.package])
        finally:
            sys.dont_write_bytecode = write_bytecode
            sys.path[:] = path_before
            for name in set(sys.modules) - modules_before:
                if name.startswith(("perilune_", script_name)):
                    del sys.modules[name]
            del retained[scripts_before:]  # except those of FMUs loaded in this process
        files = read_zip(built)
    return {name: text for name, text in files.items() if name != "modelDescription.xml"}
