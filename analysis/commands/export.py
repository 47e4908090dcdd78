"""perilune export: an FMU, a system with its FMUs inside, or the blocks of a file, to fly here or elsewhere."""

from __future__ import annotations

import argparse
import sys

from ...fmus_src.export.compilers import available_platforms
from ...fmus_src.export.judge.subset import SubsetError
from ..api.export import export
from ..common.errors import InputError
from .common.exit_status import ExitStatus
from .common.options import check_json, tell


def run(options: argparse.Namespace) -> int:
    check_json(options)
    try:
        exported = export(options.name, platforms=options.platform, flavour=options.flavour, output=options.output)
    except InputError:
        raise
    except SubsetError as error:
        for violation in error.violations:
            print(f"perilune: {error.block}: {violation}", file=sys.stderr)
        return ExitStatus.REFUSED
    except ValueError as error:  # what is wrong with a block, told by the export as one line
        print(f"perilune: {' '.join(str(error).split())}", file=sys.stderr)
        return ExitStatus.REFUSED
    if options.flavour is None and "native" not in exported.flavours and not available_platforms():
        print("perilune: no C compiler here: the Python flavour only; pip install ziglang for both", file=sys.stderr)
    paths = [str(path) for path in exported.paths]
    document = {"paths": paths, "flavours": list(exported.flavours), "platforms": list(exported.platforms)}
    return tell(document, options, lambda: print("\n".join(paths)))
