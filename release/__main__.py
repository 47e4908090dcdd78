"""Release what is committed: `python -m release [--date YYYY-MM-DD] [--output FOLDER]`.

The files are written, committed and tagged where every check passed, and left as they are where one did not.
"""

from __future__ import annotations

import argparse
import io
import shutil
import sys
import tarfile
from datetime import UTC, date, datetime
from pathlib import Path

from perilune.common.errors import ExitStatus, InputError
from perilune.common.paths import ROOT

from .archives import build_sdist, build_wheel, check_wheel, require_same_bytes
from .state import Release, git, read_release, written_files


def build(release: Release, root: Path, output: Path) -> list[Path]:
    """Build both archives twice, in two folders, into ``output``; return them. Raises InputError where they differ.

    The second wheel is built from the source distribution, as on a platform or an index without the first.
    """
    shutil.rmtree(output, ignore_errors=True)
    trees = [output / "first", output / "second" / "folder"]
    for tree in trees:
        with tarfile.open(fileobj=io.BytesIO(git(root, "archive", "HEAD"))) as archive:
            archive.extractall(tree, filter="tar")
        for path, text in written_files(release, tree).items():
            path.write_text(text, encoding="utf-8")
    sources = [build_sdist(tree, output / "dist" if tree is trees[0] else tree.parent, release) for tree in trees]
    require_same_bytes(*sources)
    wheel = build_wheel(trees[0], output / "dist", release)
    with tarfile.open(sources[1]) as archive:
        archive.extractall(trees[1].parent, filter="data")
    unpacked = trees[1].parent / sources[1].name.removesuffix(".tar.gz")
    require_same_bytes(wheel, build_wheel(unpacked, trees[1].parent, release))
    check_wheel(wheel, release)
    for tree in (trees[0], trees[1].parent):
        shutil.rmtree(tree)
    return [wheel, sources[0]]


def publish_locally(release: Release, root: Path) -> None:
    """Write the files of the release, commit them and tag the commit."""
    for path, text in written_files(release, root).items():
        path.write_text(text, encoding="utf-8")
    git(root, "commit", "--all", "--message", f"Release {release.version}")
    git(root, "tag", "--annotate", release.tag, "--message", f"Perilune {release.version}")


def main(arguments: list[str] | None = None) -> int:
    """Release, and print the archives and the tag; one line and status 2 where something is not as a release needs."""
    parser = argparse.ArgumentParser(prog="python -m release", description=__doc__.partition("\n")[0])
    today = datetime.now(UTC).date()
    parser.add_argument(
        "--date", type=date.fromisoformat, default=today, help="date of the release; default: today, UTC"
    )
    parser.add_argument(
        "--output", type=Path, default=ROOT / "build" / "release", help="folder of the archives, emptied first"
    )
    parser.add_argument("--root", type=Path, default=ROOT, help="root of the checkout")
    options = parser.parse_args(arguments)
    try:
        release = read_release(options.root, options.date)
        archives = build(release, options.root, options.output)
    except InputError as error:
        print(f"release: {error}", file=sys.stderr)
        return ExitStatus.REFUSED
    publish_locally(release, options.root)
    print(*archives, f"committed and tagged {release.tag}; push it and upload the files", sep="\n")
    return ExitStatus.MET


if __name__ == "__main__":
    raise SystemExit(main())
