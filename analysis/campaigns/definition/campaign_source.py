"""Text of a campaign: its TOML file merged with the files that it extends, and the file and line of each value."""

from __future__ import annotations

import hashlib
import os
import posixpath
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ....common.bounds import CAMPAIGN_BYTES, CAMPAIGN_FILES, INPUT_BYTES
from ....common.errors import InputError
from ....common.regular import names_file, read_input
from ...runtime.ssp.archive import SystemArchive
from .table import TomlTable

LOOKUP, FILE = "lookup", "file"  # table of tables with a file each, and their key for it
EXTENDS = "extends"
HERE = "."  # position of the file's own entries in the list of files; by default its end
Origin = tuple[str, int]  # file and line
Attached = tuple[str, bytes | None]  # a file's label, and its content (None if missing)


@dataclass(frozen=True)
class CampaignSource:
    """Campaign file: its content ``raw``, its ``label`` for messages, and the files that it ``extends``, in order.

    The file's own entries are merged after the first ``position`` extended files, by default after all of them.
    ``attached`` contains the tables of the file's lookups, by the paths that it states.
    """

    label: str
    raw: bytes
    extends: tuple[CampaignSource, ...] = ()
    position: int = 0
    attached: Mapping[str, Attached] = field(default_factory=dict)

    @property
    def sha256(self) -> str:
        """Digest of the file, of its lookup tables, and of all files that it extends."""
        digest = hashlib.sha256(self.raw)
        for _, content in self.attached.values():
            digest.update(hashlib.sha256(content or b"").digest())
        for part in self.extends:
            digest.update(bytes.fromhex(part.sha256))
        return digest.hexdigest()

    def files(self) -> Iterator[CampaignSource]:
        """Yield this file and all files that it extends."""
        yield self
        for part in self.extends:
            yield from part.files()

    def table(self) -> TomlTable:
        """Return the merged content. A later file's entry replaces an earlier entry of the same name.

        The entries of [draw], [metric], [requirement], [fault], [scatter] and [configuration] are tables; the entries
        of [set], [derive], [compare], [record], [group] and [success], and all entries in [lookup], are values. Raises
        InputError.
        """
        content: dict[str, object] = {}
        origins: dict[str, Origin] = {}
        for index, part in enumerate((*self.extends, self)):
            if index == self.position:
                self._add_own(content, origins)
            if part is not self:
                inherited = part.table()
                _merge(content, inherited.content, part.label)
                origins |= inherited.origins
        attached = {(file.label, name): each for file in self.files() for name, each in file.attached.items()}
        return TomlTable(content, self.label, origins=origins, attached=attached)

    def _add_own(self, content: dict[str, object], origins: dict[str, Origin]) -> None:
        own = parse_toml(self.raw, self.label)
        own.pop(EXTENDS, None)
        _merge(content, own, self.label)
        lines = key_lines(self.raw.decode("utf-8"))
        origins |= {name: (self.label, line) for name, line in lines.items() if name != EXTENDS}


def read_source(raw: bytes, label: str, archive: SystemArchive | None = None) -> CampaignSource:
    """Read a campaign's file, in an ``archive`` or elsewhere, with the files that it extends.

    Raises InputError, also for a cycle of files.
    """
    return _read_source(raw, label, archive, (), [label])


def read_source_file(path: Path) -> CampaignSource:
    """Read a campaign's file by its path, with the files that it extends. Raises InputError."""
    return read_source(read_input(path, "give a campaign's file", CAMPAIGN_BYTES), str(path))


def _read_source(
    raw: bytes, label: str, archive: SystemArchive | None, chain: tuple[str, ...], files: list[str]
) -> CampaignSource:
    """Read a file with the files that it extends, collected in ``files``; ``chain`` are the files that lead to it."""
    content = parse_toml(raw, label)
    names = content.get(EXTENDS, [])
    names = [names] if isinstance(names, str) else names
    if not isinstance(names, list) or not all(isinstance(name, str) and name for name in names):
        raise InputError(label, EXTENDS, f"{names!r} is not a file", 'write extends = "FILE.toml", or a list of files')
    if names.count(HERE) > 1:
        raise InputError(label, EXTENDS, f"{HERE!r} occurs twice", "list this file's own position once")
    extended = []
    for name in names:
        if name == HERE:
            continue
        inherited, other = _find(name, label, archive)
        if other in (*chain, label):
            path = " -> ".join([*chain, label, other])
            raise InputError(
                label, EXTENDS, f"files extend each other in a cycle: {path}", "remove one of these references"
            )
        CAMPAIGN_FILES.check(len(files), label, EXTENDS)
        files.append(other)
        extended.append(_read_source(inherited, other, archive, (*chain, label), files))
    attached = {name: _attach(name, label, archive) for name in _lookup_files(content)}
    position = names.index(HERE) if HERE in names else len(extended)
    return CampaignSource(label, raw, tuple(extended), position, attached)


def _lookup_files(content: Mapping[str, object]) -> list[str]:
    """Return the paths to which the lookups in a file's content refer."""
    lookups = content.get(LOOKUP)
    tables = lookups.values() if isinstance(lookups, Mapping) else ()
    files = [table[FILE].strip() for table in tables if isinstance(table, Mapping) and isinstance(table.get(FILE), str)]
    return list(dict.fromkeys(filter(None, files)))


def _attach(name: str, origin: str, archive: SystemArchive | None) -> Attached:
    """Return the file at a path relative to the file ``origin``; its content is None if it is missing."""
    inside = None if archive is None else archive.name_of(origin)
    if archive is not None and inside is not None:
        path = posixpath.normpath(posixpath.join(posixpath.dirname(inside), name))
        return archive.label_of(path), archive.read(path, origin) if path in archive.files else None
    file = Path(os.path.normpath(os.path.join(os.path.dirname(origin), name)))
    return str(file), read_input(file, "name another lookup file", INPUT_BYTES) if names_file(file) else None


def _find(name: str, origin: str, archive: SystemArchive | None) -> tuple[bytes, str]:
    """Find a file that ``origin`` extends: by relative path, or else by name among the system's campaigns."""
    inside = None if archive is None else archive.name_of(origin)
    if archive is not None and inside is not None:
        path = posixpath.normpath(posixpath.join(posixpath.dirname(inside), name))
        if path in archive.files:
            return archive.read(path, origin), archive.label_of(path)
    else:
        file = Path(os.path.normpath(os.path.join(os.path.dirname(origin), name)))
        if names_file(file):
            return read_input(file, "extend another file", CAMPAIGN_BYTES), str(file)
    known = [] if archive is None else archive.campaign_names()
    if archive is not None:
        path = archive.campaign_path(name)  # a copy of a system's campaign extends the same files as the original
        if path in archive.files:
            return archive.read(path, origin), archive.label_of(path)
        if name in known:
            return archive.campaign(name)
    remedy = f"give a path relative to this file{', or a campaign: ' + ', '.join(known) if known else ''}"
    raise InputError(origin, EXTENDS, f"no file {name}", remedy)


def parse_toml(raw: bytes, label: str) -> dict[str, object]:
    """Return the content of a TOML file. Raises InputError."""
    CAMPAIGN_BYTES.check(len(raw), label, "")
    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError(label, f"byte {error.start}", "not UTF-8", "save the file as UTF-8") from error
    if LONG_NAME.search(text):
        raise InputError(label, "", f"a key has more than {MOST_SEGMENTS} dotted parts", "correct the file")
    try:
        content = tomllib.loads(text)
        _check_integers(content, "", label)
    except RecursionError as error:
        raise InputError(label, "", "not TOML: arrays or tables are nested too deeply", "correct the file") from error
    except ValueError as error:  # also raised for integers of many thousand digits
        if isinstance(error, InputError):
            raise
        raise InputError(label, "", f"not TOML: {error}", "correct the file at that place") from error
    return content


def _check_integers(entry: object, name: str, label: str) -> None:
    """Reject integers with more bits than TOML permits."""
    if isinstance(entry, dict):
        for key, inner in entry.items():
            _check_integers(inner, f"{name}.{key}" if name else key, label)
    elif isinstance(entry, list):
        for index, inner in enumerate(entry):
            _check_integers(inner, f"{name}[{index + 1}]", label)
    elif isinstance(entry, int) and not -(2**63) <= entry < 2**63:
        raise InputError(label, name, "an integer of more than 64 bits", "give a smaller number")


def _merge(content: dict[str, object], later: Mapping[str, object], label: str) -> None:
    """Merge a later file into ``content``: tables by entry, all other values as units.

    Its configurations replace compared FMUs of earlier files, and its compared FMUs replace earlier configurations.
    """
    variants = [key for key in VARIANTS if later.get(key)]
    if len(variants) == 1:
        content.pop(VARIANTS[1 - VARIANTS.index(variants[0])], None)
    for key, value in later.items():
        if isinstance(value, Mapping):
            table = TomlTable(value, label, key)
            entries = dict(table.flat(of_tables=True) if key == "draw" else table.flat() if key in FLAT else value)
            earlier = content.get(key)
            content[key] = _join(earlier, entries, deep=key == LOOKUP) if isinstance(earlier, Mapping) else entries
        else:
            content[key] = value


def _join(earlier: Mapping[str, object], later: Mapping[str, object], deep: bool) -> dict[str, object]:
    """Return two merged tables; if ``deep``, entries of the same name are merged as well."""
    both = {
        name: _join(earlier[name], table, deep)  # type: ignore[arg-type]
        for name, table in later.items()
        if deep and isinstance(table, Mapping) and isinstance(earlier.get(name), Mapping)
    }
    return {**earlier, **later, **both}


VARIANTS = ("compare", "configuration")  # tables that exclude each other
FLAT = ("set", "derive", "compare")  # tables whose names have dots


KEY = r"""(?:[A-Za-z0-9_-]+|"(?:[^"\\]|\\.)*"|'[^']*')"""
MOST_SEGMENTS = 100  # most segments of a name, since tomllib's time grows with their square
LONG_NAME = re.compile(rf"""(?<![\w.-])(?>{KEY}(?:[ \t]*+\.[ \t]*+{KEY}){{{MOST_SEGMENTS}}})""")
DOTTED = rf"{KEY}(?:\s*\.\s*{KEY})*"
HEADER = re.compile(rf"\s*\[(?P<array>\[)?\s*(?P<name>{DOTTED})\s*\]")
ENTRY = re.compile(rf"\s*(?P<name>{DOTTED})\s*=")
TOKEN = re.compile(r"""\"{3}|\'{3}|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'|#[^\n]*|[\[\]{}]""")


def key_lines(text: str) -> dict[str, int]:
    """Return the line of each key by its dotted name, such as ``draw.x.low``, without quotes. ``text`` is TOML."""
    lines: dict[str, int] = {}
    prefix, position, number = "", 0, 1
    while position < len(text):
        end = text.find("\n", position)
        end = len(text) if end < 0 else end
        header, entry = HEADER.match(text, position, end), ENTRY.match(text, position, end)
        if header:
            prefix = _plain(header["name"])
            lines.setdefault(prefix, number)
        elif entry:
            name = _plain(entry["name"])
            lines[f"{prefix}.{name}" if prefix else name] = number
            end = _value_end(text, entry.end())
        number += text.count("\n", position, end + 1)
        position = end + 1
    return lines


def _plain(name: str) -> str:
    return ".".join(part.strip("\"'") for part in re.findall(KEY, name))


def _value_end(text: str, position: int) -> int:
    """Return the end of the line on which a value ends, from the position at which the value begins."""
    depth = 0
    while position < len(text):
        if text[position] == "\n" and not depth:
            return position
        token = TOKEN.match(text, position)
        if token is None:
            position += 1
            continue
        position = token.end()
        if token[0] in ('"""', "'''"):
            position = text.index(token[0], position) + 3
            while text.startswith(token[0][0], position):  # up to two quotes may precede the closing three
                position += 1
        depth += (token[0] in ("[", "{")) - (token[0] in ("]", "}"))
    return len(text)
