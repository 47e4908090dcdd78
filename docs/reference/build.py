"""Builder of the site: written and derived pages in one folder, which Zensical converts to HTML."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

from docs.files import insert_files
from perilune.common.errors import InputError
from perilune.common.paths import BUILD, PACKAGE
from perilune.fmus_src.catalogue import catalogue

from .diagrams import add_diagrams
from .links import broken_links
from .markup.block_links import link_blocks
from .markup.formulas import typeset
from .pages import TOP, derived_pages, reference_navigation

DOCS = TOP / "docs"
SETTINGS = DOCS / "site" / "site.toml"
PYTHON = {
    "docstring_style": "numpy",  # numpydoc sections, if any; other docstrings are prose
    "filters": ["!^_"],
    "heading_level": 2,
    "members_order": "source",
    "separate_signature": True,
    "show_bases": False,
    "show_root_full_path": False,
    "show_root_heading": True,
    "show_signature_annotations": True,
    "show_source": False,
}


def build_site(output: Path, sources: Path) -> None:
    """Write the site to ``output``, and its Markdown sources to ``sources``.

    Raises InputError for a page missing from the navigation, and for broken links, anchors and images.
    """
    for folder in (sources, output):
        shutil.rmtree(folder, ignore_errors=True)
    left_out = shutil.ignore_patterns("*.py", "*.jinja", "__pycache__", "figures", "files", "formats")
    shutil.copytree(DOCS, sources / "docs", ignore=left_out)
    for name, text in derived_pages().items():
        path = sources / "docs" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    add_diagrams(sources / "docs")
    for path in (sources / "docs").rglob("*.md"):
        page = path.relative_to(sources / "docs").as_posix()
        text = insert_files(path.read_text(encoding="utf-8"))
        linked = text if page.startswith("reference/") else link_blocks(text, page, catalogue())
        path.write_text(typeset(linked), encoding="utf-8")
    settings = site_settings()
    written = {path.relative_to(sources / "docs").as_posix() for path in (sources / "docs").rglob("*.md")}
    for name in sorted(written - set(pages_of(settings["nav"]))):
        raise InputError(name, "navigation", "the page is not in it", f"list it in {SETTINGS.relative_to(TOP)}")
    (sources / "mkdocs.yml").write_text(json.dumps(settings), encoding="utf-8")  # JSON is YAML
    command = [sys.executable, "-m", "zensical", "build", "--strict", "--config-file", "mkdocs.yml"]
    plain = {**os.environ, "NO_COLOR": "1"}
    done = subprocess.run(command, cwd=sources, capture_output=True, text=True, check=False, env=plain)
    if done.returncode:
        print(done.stdout, done.stderr.partition("Traceback")[0], file=sys.stderr)
        reason = (done.stderr.strip().splitlines() or ["no reason given"])[-1]
        raise InputError("docs", "zensical build", reason, "fix the places listed above")
    shutil.move(sources / "site", output)
    for page, target in broken_links(output):
        raise InputError(page, target, "leads nowhere", "fix the link")


def site_settings() -> dict[str, Any]:
    """Return docs/site/site.toml with the reference and path-dependent entries added."""
    settings = tomllib.loads(SETTINGS.read_text(encoding="utf-8"))
    doors = [entries for door in settings["nav"] for entries in door.values()]
    (reference,) = [entry for entries in doors for entry in entries if "Reference" in entry]
    reference["Reference"] = reference_navigation()
    settings["plugins"].append(
        {"mkdocstrings": {"handlers": {"python": {"paths": [str(PACKAGE.parent)], "options": PYTHON}}}}
    )
    return settings | {"docs_dir": "docs", "site_dir": "site", "use_directory_urls": False}


def pages_of(navigation: Any) -> list[str]:
    """Return the pages of a ``nav`` in order."""
    if isinstance(navigation, str):
        return [navigation]
    inner = navigation.values() if isinstance(navigation, dict) else navigation
    return [page for entry in inner for page in pages_of(entry)]


def main(arguments: list[str] | None = None) -> int:
    """Run build_docs.py; return the exit status."""
    parser = argparse.ArgumentParser(prog="build_docs.py", description="Build the documentation site.")
    parser.add_argument("--output", type=Path, default=BUILD / "site", metavar="DIR", help="default: build/site")
    options = parser.parse_args(arguments)
    try:
        build_site(options.output, options.output.with_name(f"{options.output.name}_sources"))
    except InputError as error:
        print(f"build_docs.py: {error}", file=sys.stderr)
        return 2
    print(f"wrote {options.output / 'index.html'}")
    return 0
