"""Builds the FMUs into the wheel; everything else about the package is in pyproject.toml."""

import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

# As build_fmus.py, which a source distribution does not hold.
BUILD_FMUS = "from perilune.fmus_src.export.command import main; raise SystemExit(main())"


class BuildWithFmus(build_py):
    """Packs what `build_fmus.py` builds, so that an installed package flies without a checkout or a compiler.

    Python FMUs are not among them: `fmus_src/export/available.py` builds these where they are asked for. An editable
    installation flies what lies in the checkout's build folder instead.
    """

    def run(self) -> None:
        if self.editable_mode:
            super().run()
            return
        shutil.rmtree(self.build_lib, ignore_errors=True)  # else files that are no more would be packed again
        super().run()
        output = (Path(self.build_lib) / "perilune" / "build").resolve()
        options = ["--output", output, "--flavour", "native", "--portable"]
        for platform in ("linux64", "win64", "darwin64"):
            options += ["--platform", platform]
        subprocess.run([sys.executable, "-c", BUILD_FMUS, *options], cwd=Path(__file__).parent, check=True)
        shutil.rmtree(output / "ssp")  # holds the FMUs a second time


setup(cmdclass={"build_py": BuildWithFmus})
