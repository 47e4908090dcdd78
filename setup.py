"""Builds the FMUs into the wheel; everything else about the package is in pyproject.toml."""

import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py


class BuildWithFmus(build_py):
    """Packs what `build_fmus.py` builds, so that an installed package flies without a checkout or a compiler.

    An editable installation flies what lies in the checkout's build folder instead.
    """

    def run(self) -> None:
        super().run()
        if not self.editable_mode:
            output = (Path(self.build_lib) / "perilune" / "build").resolve()
            subprocess.run([sys.executable, Path(__file__).with_name("build_fmus.py"), "--output", output], check=True)
            for scrap in ("cache", "ssp"):  # compiled libraries, and archives that hold the FMUs a second time
                shutil.rmtree(output / scrap)


setup(cmdclass={"build_py": BuildWithFmus})
