"""Size on disk of what `pip install perilune` installs, alone and with each extra.

    python -m release.sizes [WHEEL]

Installs the wheel with the versions of constraints.txt, in an environment for each, and adds up the files of its
site-packages with their bytecode, in bytes. Writes `release/sizes.json`, which README and docs are compared with,
and prints it, with the largest packages.
"""

from __future__ import annotations

import argparse
import json
import platform
import subprocess
import sys
import tempfile
import tomllib
import venv
from importlib.metadata import distributions, version
from pathlib import Path

from perilune.common.paths import ROOT

STORED = Path(__file__).with_suffix(".json")
LARGEST = 12  # packages that are listed
TOOLS = ("docs", "dev")  # extras for developers of Perilune
PIP = ("-m", "pip", "--disable-pip-version-check", "--python")


def install(requirement: str, folder: Path) -> Path:
    """Install a requirement into a new environment without pip; return its site-packages."""
    venv.create(folder)
    lock = ROOT / "constraints.txt"
    python = folder / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    command = [sys.executable, *PIP, str(python), "install", "--quiet", "--constraint", str(lock), requirement]
    subprocess.run(command, check=True)
    (site,) = folder.rglob("site-packages")
    return site


def size_of(site: Path) -> int:
    """Return the bytes of all files below a folder."""
    return sum(path.stat().st_size for path in site.rglob("*") if path.is_file() and not path.is_symlink())


def sizes_by_package(site: Path) -> dict[str, int]:
    """Return the bytes of each package of an environment by its name, the largest first."""
    sizes = {}
    for each in distributions(path=[str(site)]):
        paths = {Path(str(file.locate())) for file in each.files or ()}
        sizes[each.name] = sum(path.stat().st_size for path in paths if path.is_file())
    return dict(sorted(sizes.items(), key=lambda each: -each[1]))


def measure(wheel: Path) -> dict[str, object]:
    """Return the sizes in bytes: of the wheel, of environments by extra (none: ``""``), of the largest packages."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    installed: dict[str, int] = {}
    packages: dict[str, int] = {}
    for extra in ("", *(name for name in project["optional-dependencies"] if name not in TOOLS)):
        with tempfile.TemporaryDirectory() as folder:
            site = install(f"{wheel}[{extra}]" if extra else str(wheel), Path(folder))
            installed[extra] = size_of(site)
            packages = packages or sizes_by_package(site)
    return {
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}",
        "wheel": wheel.stat().st_size,
        "installed": installed,
        "packages": dict(list(packages.items())[:LARGEST]),
    }


def main() -> None:
    """Measure, store and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    default = ROOT / "build" / "wheel" / f"perilune-{version('perilune')}-py3-none-any.whl"
    parser.add_argument(
        "wheel", nargs="?", type=Path, default=default, help="wheel to measure; default: that of `make wheel`"
    )
    sizes = measure(parser.parse_args().wheel.resolve())
    STORED.write_text(json.dumps(sizes, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(sizes, indent=1))


if __name__ == "__main__":
    main()
