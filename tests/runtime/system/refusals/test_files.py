"""Invalid files are refused: XML with a DOCTYPE, broken FMUs, invalid archives, archives that would write elsewhere.

Truth: the table of refusals in docs/command_line.md and the FMI 2.0 and SSP 1.0 standards, each violated in one place
by a file here. They are read through the command line's `main` in this process.
"""

import io
import re
import zipfile

import pytest

from perilune.common.errors import InputError
from perilune.common.zips import open_zip, read_entry
from tests.support.builders import document, external, inline, mapping, parameter_set, system, write_zip
from tests.support.refused import PLAIN, RAMP, ssp

DOCTYPE = '<!DOCTYPE x [<!ENTITY a "b">]>'


def with_doctype(text, encoding="utf-8"):
    return f'<?xml version="1.0" encoding="{encoding}"?>\n{DOCTYPE}\n{text}'.encode(encoding)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-16-le"])
def test_doctype_in_a_description(tmp_path, tiny, refused, encoding):
    path = ssp(tmp_path, tiny, files={"SystemStructure__ssd": with_doctype(document(PLAIN), encoding)})
    refused(path, "SystemStructure.ssd: DOCTYPE", "remove")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_doctype_in_a_parameter_set(tmp_path, tiny, refused, encoding):
    text = with_doctype(parameter_set("ramp.start=Real:2"), encoding)
    path = ssp(tmp_path, tiny, system(RAMP, bindings=external("resources/a.ssv")), files={"resources___a__ssv": text})
    refused(path, "a.ssv: DOCTYPE")
    (tmp_path / "b.ssv").write_bytes(text)
    refused(ssp(tmp_path, tiny, system(RAMP)), "b.ssv: DOCTYPE", options=["--parameters", "b.ssv"])


def test_doctype_in_a_mapping(tmp_path, tiny, refused):
    entry = mapping('<ssm:MappingEntry source="a" target="ramp.start"/>')
    binding = inline("a=Real:1", mapping='<ssd:ParameterMapping source="resources/m.ssm"/>')
    files = {"resources___m__ssm": with_doctype(entry)}
    refused(ssp(tmp_path, tiny, system(RAMP, bindings=binding), files=files), "m.ssm: DOCTYPE")


def fmu_files(tiny, name="ramp"):
    with zipfile.ZipFile(tiny / f"{name}.fmu") as archive:
        return {entry: archive.read(entry) for entry in archive.namelist()}


def zipped(files):
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return buffer.getvalue()


def truncated(tiny):
    whole = (tiny / "ramp.fmu").read_bytes()
    return whole[: len(whole) // 2]


def scrambled(tiny):
    """Change one byte inside the compressed data of the largest file."""
    data = bytearray((tiny / "ramp.fmu").read_bytes())
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        largest = max(archive.infolist(), key=lambda entry: entry.compress_size)
    data[largest.header_offset + 60 + largest.compress_size // 2] ^= 0xFF
    return bytes(data)


def described(tiny, change):
    files = fmu_files(tiny)
    text = files["modelDescription.xml"].decode()
    changed = change(text)
    assert changed != text
    files["modelDescription.xml"] = changed if isinstance(changed, bytes) else changed.encode()
    return zipped(files)


def of_another_platform(tiny, source):
    """Return the FMU as one that runs without Python, with a file in sources and no binary for Linux."""
    files = {path: content for path, content in fmu_files(tiny).items() if "linux" not in path}
    text = files["modelDescription.xml"].decode().replace('needsExecutionTool="true"', 'needsExecutionTool="false"')
    return zipped(files | {"modelDescription.xml": text.encode(), f"sources/{source}": b""})


def model_exchange(text):
    text = re.sub(r"<CoSimulation[^>]*?(/>|>)", r'<ModelExchange modelIdentifier="ramp"\1', text)
    return text.replace("</CoSimulation>", "</ModelExchange>")


BROKEN_FMUS = {
    "not a zip": (lambda tiny: b"this is no zip", ["not a readable zip", "build or copy"]),
    "empty": (lambda tiny: b"", ["not a readable zip"]),
    "truncated": (truncated, ["not a readable zip"]),
    "scrambled": (scrambled, ["cannot be unpacked"]),
    "no description": (lambda tiny: zipped({"a": b""}), ["modelDescription.xml", "not found"]),
    "slip": (lambda tiny: zipped(fmu_files(tiny) | {"../evil": b"x"}), ["../evil", "leads out of the archive"]),
    "deep slip": (lambda tiny: zipped(fmu_files(tiny) | {"a/../../evil": b"x"}), ["leads out of the archive"]),
    "absolute": (lambda tiny: zipped(fmu_files(tiny) | {"/tmp/evil": b"x"}), ["leads out of the archive"]),
    "backslash": (lambda tiny: zipped(fmu_files(tiny) | {"..\\evil": b"x"}), ["the file name contains a backslash"]),
    "drive": (lambda tiny: zipped(fmu_files(tiny) | {"C:evil": b"x"}), ["leads out of the archive"]),
    "doctype": (
        lambda tiny: described(tiny, lambda text: text.replace("<fmiModel", f"{DOCTYPE}<fmiModel")),
        ["modelDescription.xml: DOCTYPE"],
    ),
    "no XML": (lambda tiny: described(tiny, lambda text: text[:400]), ["not well-formed"]),
    "draft of FMI 3": (
        lambda tiny: described(tiny, lambda text: text.replace('fmiVersion="2.0"', 'fmiVersion="3.0-beta.2"')),
        ["fmiVersion", "'3.0-beta.2' is not supported", "FMI 2.0 or 3.0"],
    ),
    "FMI 2 named 3": (
        lambda tiny: described(tiny, lambda text: text.replace('fmiVersion="2.0"', 'fmiVersion="3.0"')),
        ["no attribute instantiationToken", "fix the FMU"],
    ),
    "FMI 1": (lambda tiny: described(tiny, lambda text: text.replace('n="2.0"', 'n="1.0"')), ["'1.0' is not"]),
    "no value references": (
        lambda tiny: described(tiny, lambda text: re.sub(r' valueReference="\d+"', "", text)),
        ["ScalarVariable (line 23): no attribute valueReference; fix the FMU"],
    ),
    "model exchange": (lambda tiny: described(tiny, model_exchange), ["CoSimulation", "not a co-simulation FMU"]),
    "other platform": (
        lambda tiny: zipped({key: value for key, value in fmu_files(tiny).items() if "linux" not in key}),
        ["binaries/", "no binary for this platform; use its native flavour"],
    ),
    "other platform, with sources": (
        lambda tiny: of_another_platform(tiny, "compile.c"),
        ["no binary for this platform; compile the FMU's sources for this platform"],
    ),
    "other platform, without sources": (
        lambda tiny: of_another_platform(tiny, "readme.txt"),
        ["no binary for this platform; export the FMU for this platform"],
    ),
    "binary that is none": (
        lambda tiny: zipped({key: b"x" if "linux" in key else value for key, value in fmu_files(tiny).items()}),
        ["ramp", "cannot be instantiated"],
    ),
}


@pytest.mark.parametrize("name", BROKEN_FMUS)
def test_fmus(tmp_path, tiny, refused, name):
    make, words = BROKEN_FMUS[name]
    path = ssp(tmp_path, tiny, system(RAMP), files={"resources___ramp__fmu": make(tiny)})
    refused(path, "broken.ssp!resources/ramp.fmu", *words)
    assert not (tmp_path.parent / "evil").exists()


def test_a_misspelt_description_is_named_where_it_decides(tmp_path, tiny, refused):
    fmu = described(tiny, lambda text: text.replace("causality", "casualty"))
    path = ssp(tmp_path, tiny, system(RAMP), files={"resources___ramp__fmu": fmu})
    refused(path, "SystemStructure.ssd: ramp.y (line 6): is local in", "'casualty' is not allowed")


def test_an_fmu_whose_every_byte_may_be_wrong(tiny):
    """Damage anywhere is refused or harmless, never a traceback; 200 places."""
    whole = (tiny / "ramp.fmu").read_bytes()
    refusals = 0
    for k in range(200):
        data = bytearray(whole)
        data[(k * 7919 + 13) % len(data) if k % 2 else len(data) - 1 - 3 * k] ^= 1 << (k % 8)
        try:
            archive = open_zip(bytes(data), "x.fmu")
            for name in archive.namelist():
                read_entry(archive, name, "x.fmu")
        except InputError:
            refusals += 1
    assert refusals > 100


def test_archives(tmp_path, refused):
    path = tmp_path / "broken.ssp"
    path.write_bytes(b"no zip")
    refused(path, "broken.ssp: archive: not a readable zip")
    write_zip(path, {"readme.txt": "x", "other.ssd": document(PLAIN)})
    refused(path, "SystemStructure.ssd", "not found", "SSDs here: other")
    write_zip(path, {"SystemStructure.ssd": document(PLAIN), "../evil": "x"})
    refused(path, "../evil", "leads out of the archive")
    assert not (tmp_path.parent / "evil").exists()
    (tmp_path / "folder").mkdir()
    refused(tmp_path / "folder", "SystemStructure.ssd", "not found")
    refused(tmp_path / "nowhere.ssp", "neither a system, a folder nor a file", "lunar_terminal_guidance")
    refused("lunar_terminal_guidence", "neither a system", "lunar_terminal_guidance")
    refused("x" * 5000, "name too long")
