"""Sources of components that are URIs of other tools: the files that they mean."""

from __future__ import annotations

from urllib.parse import urlsplit

PROXY = "proxyfmu://"
HERE = ("localhost", "127.0.0.1")


def source_file(source: str) -> str:
    """The file that a component's source names.

    libcosim, Ecos and Vico fly ``proxyfmu://localhost?file=x.fmu`` in a process of its own, which is x.fmu with the
    same values; on another machine it is none of the system's files, and stays as it is.
    """
    if source.startswith(PROXY):
        _, _, file = source.partition("?file=")
        if file and urlsplit(source.removesuffix(f"?file={file}")).hostname in HERE:
            return file
    return source


def is_elsewhere(source: str) -> bool:
    """Whether a source is on another machine."""
    return source.startswith(PROXY)
