"""Input that is wrong is refused: exit status, one line with file, element and remedy, and nothing written.

Truth: the table of refusals in docs/command_line.md and the FMI 2.0 and SSP 1.0 standards, which the
broken files here break in one place each. Most go through the command line's `main` in this
process; a handful through the installed command.
"""

import io
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.support.builders import (
    component,
    connection,
    connectors,
    document,
    external,
    inline,
    inline_mapping,
    mapping,
    pack,
    parameter_set,
    retouched,
    system,
    write_zip,
)

RAMP = component("ramp", "ramp", "output y Real m; output count Integer; output flag Boolean")
GAIN = component("gain", "gain", "input u Real m; output y Real m")
WIRED = connection("ramp.y", "gain.u")
PLAIN = system(RAMP, GAIN, connections=WIRED)
ONE_LINE = re.compile(r"perilune: (?P<file>[^:]+): (?P<rest>.+); (?P<remedy>[^;]+.*)\n")


@pytest.fixture
def refused(tmp_path, capfd, monkeypatch):
    """Runs `perilune run PATH --output ...` in this process and checks the form of the refusal."""
    from perilune.analysis.cli import main

    monkeypatch.chdir(tmp_path)

    def check(path, *words, options=(), status=2, verb=("run",)):
        before = sorted(tmp_path.rglob("*"))
        written = () if verb != ("run",) else ("--output", str(tmp_path / "out" / "flight.csv"))
        code = main([*verb, str(path), *options, *written])
        output = capfd.readouterr()
        assert code == status, output.err
        match = ONE_LINE.fullmatch(output.err)
        assert match, output.err
        assert status == 1 or "Traceback" not in output.err  # a run that fails shows the FMU's own log
        said = output.err.replace(str(tmp_path), "")  # whose name is that of the test
        for word in words:
            assert word in said, said
        if status == 2:
            assert output.out == ""
            assert sorted(tmp_path.rglob("*")) == before
        return output.err

    return check


@pytest.fixture
def tiny(tiny_folder):
    """One flavour is enough: nothing here flies."""
    return tiny_folder / "python"


def ssp(tmp_path, tiny, root=PLAIN, /, name="broken.ssp", **options):
    files = options.pop("files", {})
    return pack(tmp_path / name, tiny, document(root, **options), **files)


TABLE = {
    # name: (root system, words of the refusal)
    "unknown variable": (
        system(component("ramp", "ramp", "output z Real m")),
        ["ramp.z", "no variable of this name", "correct the connector"],
    ),
    "wrong causality": (
        system(component("gain", "gain", "output u Real m")),
        ["gain.u", "is input", "output here", "correct the connector's kind"],
    ),
    "wrong type": (
        system(component("ramp", "ramp", "output y Integer")),
        ["ramp.y", "is Real", "Integer here", "correct the connector's type"],
    ),
    "wrong unit": (
        system(component("ramp", "ramp", "output y Real s")),
        ["ramp.y", "unit is m", "s here", "correct the connector's unit"],
    ),
    "same dimension, other unit": (
        system(component("ramp", "ramp", "output y Real km")),
        ["ramp.y", "unit is m", "km here"],
    ),
    "unit that nobody defines": (
        system(component("ramp", "ramp", "output y Real furlong")),
        ["ramp.y", "furlong", "define it"],
    ),
    "units that do not convert": (
        system(component("angle", "angle", "output y Real rad"), GAIN, connections=connection("angle.y", "gain.u")),
        ["angle.y -> gain.u", "units do not fit: rad and m", "correct the unit"],
    ),
    "types that do not convert": (
        system(RAMP, GAIN, connections=connection("ramp.flag", "gain.u")),
        ["ramp.flag -> gain.u", "Boolean and Real"],
    ),
    "Real to Integer": (
        system(
            RAMP,
            component("whole", "whole", "input n Integer"),
            connections=connection("ramp.y", "whole.n"),
        ),
        ["ramp.y -> whole.n", "Real and Integer"],
    ),
    "open input": (system(RAMP, GAIN), ["gain.u", "neither connected nor given a value", "--set gain.u=VALUE"]),
    "open root input": (
        system(GAIN, declared="input in Real m", connections=connection("in", "gain.u")),
        ["neither connected nor given a value", "--set in=VALUE"],
    ),
    "driven twice": (
        system(RAMP, GAIN, connections=WIRED + connection("ramp.count", "gain.u")),
        ["gain.u", "driven twice", "ramp.y", "remove one"],
    ),
    "signal that nobody drives": (
        system(
            GAIN,
            system(declared="output empty Real m", name="inner"),
            connections=connection("inner.empty", "gain.u"),
        ),
        ["inner.empty", "never driven"],
    ),
    "no such element": (
        system(RAMP, GAIN, connections=connection("romp.y", "gain.u")),
        ["no element romp", "use one of", "ramp"],
    ),
    "no such connector": (
        system(RAMP, GAIN, connections=connection("ramp.yy", "gain.u")),
        ["ramp declares no connector yy", "use one of"],
    ),
    "two elements of one name": (system(RAMP, RAMP), ["ramp", "two elements of this name"]),
    "two flat names": (
        system(
            component("a.ramp", "ramp"),
            system(component("ramp", "ramp"), name="a"),
        ),
        ["a.ramp", "two components have this name", "rename"],
    ),
    "connector twice": (system(component("ramp", "ramp", "output y Real m; output y Real m")), ["declared twice"]),
    "inout connector": (
        system(component("ramp", "ramp", "inout y Real m")),
        ["y (line", "inout connectors are not supported", "declare it input or output"],
    ),
    "Binary connector": (system(declared="input blob Binary"), ["blob", "Binary"]),
    "model exchange": (
        system(component("ramp", "ramp", attributes='implementation="ModelExchange"')),
        ["ramp", 'implementation="ModelExchange" is not supported', "co-simulation"],
    ),
    "a system description as a component": (
        system(component("inner", "inner.ssd", attributes='type="application/x-ssp-definition"')),
        ["inner", "application/x-ssp-definition", "use an FMU"],
    ),
    "an ssd without saying so": (system(component("inner", "inner.ssd")), ["inner", "is not an .fmu"]),
    "an ssp as a component": (
        system(component("inner", "inner.ssp", attributes='type="application/x-ssp-package"')),
        ["inner", "application/x-ssp-package"],
    ),
    "missing FMU": (system(component("ramp", "romp")), ["ramp", "no file resources/romp.fmu", "add the file"]),
    "calculated parameters": (
        system(
            system(declared="calculatedParameter c Real m", name="inner"),
            system(declared="parameter p Real m", name="other"),
            connections=connection("inner.c", "other.p"),
        ),
        ["inner.c -> other.p", "calculated parameters are not passed", "parameter set"],
    ),
    "calculated parameter into an input": (
        system(
            GAIN,
            system(declared="calculatedParameter c Real m", name="inner"),
            connections=connection("inner.c", "gain.u"),
        ),
        ["calculated parameters are not passed"],
    ),
    "parameter into an input": (
        system(GAIN, declared="parameter p Real m", connections=connection("p", "gain.u")),
        ["connects parameter p with input gain.u", "connect parameters with parameters"],
    ),
    "output into a parameter": (
        system(
            RAMP,
            component("gain", "gain", "parameter factor Real 1"),
            connections=connection("ramp.count", "gain.factor"),
        ),
        ["connects output ramp.count with parameter gain.factor"],
    ),
    "mapping on a Real": (
        system(
            RAMP,
            GAIN,
            connections=connection(
                "ramp.y",
                "gain.u",
                '<ssc:IntegerMappingTransformation><ssc:MapEntry source="1" target="2"/>'
                "</ssc:IntegerMappingTransformation>",
            ),
        ),
        ["IntegerMappingTransformation on a value of type Real"],
    ),
    "factor on a Boolean": (
        system(
            RAMP,
            component("whole", "whole", "input b Boolean"),
            connections=connection("ramp.flag", "whole.b", '<ssc:LinearTransformation factor="2"/>'),
        ),
        ["LinearTransformation on a value of type Boolean"],
    ),
    "parameter of no one": (
        system(RAMP, bindings=inline("ramp.stort=Real:1")),
        ["ramp.stort", "matches no parameter", "ramp.start", "--allow-unmatched"],
    ),
    "parameter of no component": (system(RAMP, bindings=inline("romp.start=Real:1")), ["romp.start", "matches no"]),
    "an output as a parameter": (system(RAMP, bindings=inline("ramp.y=Real:1")), ["ramp.y", "matches no parameter"]),
    "parameter of wrong type": (
        system(RAMP, bindings=inline("ramp.start=Boolean:true")),
        ["ramp.start", "is Boolean, the variable is Real", "give a Real"],
    ),
    "Real for an Integer": (system(RAMP, bindings=inline("ramp.flag_at=Real:1")), ["is Real, the variable is Integer"]),
    "parameter of wrong unit": (
        system(RAMP, bindings=inline("ramp.start=Real:1 s")),
        ["ramp.start", "unit s does not fit m"],
    ),
    "parameter in an unknown unit": (system(RAMP, bindings=inline("ramp.start=Real:1 ell")), ["unit ell"]),
    "parameter twice": (system(RAMP, bindings=inline("ramp.start=Real:1; ramp.start=Real:2")), ["given twice"]),
    "parameter above its maximum": (
        system(component("gain", "gain"), bindings=inline("gain.factor=Real:101")),
        ["gain.factor", "101", "above the maximum 100"],
    ),
    "parameter not finite": (system(RAMP, bindings=inline("ramp.start=Real:INF")), ["ramp.start", "not finite"]),
    "mapping of nothing": (
        system(
            RAMP,
            bindings=inline("a=Real:1", mapping=inline_mapping('<ssm:MappingEntry source="b" target="ramp.start"/>')),
        ),
        ["b (line", "has no such parameter"],
    ),
    "missing parameter set": (system(RAMP, bindings=external("resources/none.ssv")), ["no file resources/none.ssv"]),
    "parameter set elsewhere": (
        system(RAMP, bindings='<ssd:ParameterBinding source="x.ssv" sourceBase="component"/>'),
        ["sourceBase", "use SSD"],
    ),
    "parameter set of another kind": (
        system(RAMP, bindings='<ssd:ParameterBinding source="x.csv" type="text/csv"/>'),
        ["text/csv", "application/x-ssp-parameter-set"],
    ),
    "no signal dictionary": (
        system(
            GAIN,
            f'<ssd:SignalDictionaryReference name="here" dictionary="bus">{connectors("output h Real m")}'
            "</ssd:SignalDictionaryReference>",
            connections=connection("here.h", "gain.u"),
        ),
        ["no signal dictionary bus"],
    ),
    "what the schema forbids": (system(RAMP).replace("<ssd:Elements>", "<ssd:Elements><x/>"), ["not valid SSP 1.0"]),
    "an element that SSP does not have": (
        system(RAMP, extra='<ssd:Solver kind="rk4"/>'),
        ["not valid SSP 1.0", "Solver"],
    ),
}


@pytest.mark.parametrize("name", TABLE)
def test_descriptions(tmp_path, tiny, refused, name):
    root, words = TABLE[name]
    path = ssp(tmp_path, tiny, root)
    text = refused(path, *words)
    assert text.startswith((f"perilune: {path}/SystemStructure.ssd: ", f"perilune: {path}: "))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--set", "gain.factor=101"], ["--set: gain.factor", "maximum"]),
        (["--set", "gain.factor=x"], ["--set: gain.factor", "'x' is not of type Real"]),
        (["--set", "gain.factor=nan"], ["--set: gain.factor", "not finite"]),
        (["--set", "ramp.flag_at=1.5"], ["--set: ramp.flag_at", "not of type Integer"]),
        (["--set", "ramp.first_count=3000000000"], ["--set: ramp.first_count", "32 bits"]),
        (["--set", "ramp.inverted=yes"], ["--set: ramp.inverted", "write true or false"]),
        (["--set", "ramp.stort=1"], ["--set: ramp.stort", "matches no parameter", "ramp.start"]),
        (["--set", "ramp.start"], ["--set: ramp.start", "not of the form"]),
        (["--set", "=1"], ["--set: =1", "not of the form"]),
        (["--use", "gain"], ["--use: gain", "not of the form SLOT=FMU"]),
        (["--use", "gian=gain"], ["--use: gian", "no such component", "gain, ramp"]),
        (["--use", "gain=nothing_of_this_name"], ["--use: nothing_of_this_name", "no such FMU is built"]),
        (["--use", "gain=nowhere/x.fmu"], ["--use: nowhere/x.fmu", "no such file"]),
        (["--parameters", "nowhere.ssv"], ["--parameters", "no nowhere.ssv"]),
        (["--variant", "other"], ["--variant", "no variant other", "SystemStructure"]),
        (["--stop-time", "1.1"], ["--stop-time", "whole number of steps", "for instance --stop-time 1"]),
        (["--stop-time", "-1"], ["--stop-time"]),
        (["--step", "0"], ["--step", "not a positive number"]),
        (["--step", "-0.1"], ["--step", "not a positive number"]),
        (["--step", "0.3"], ["--stop-time", "whole number of steps of 0.3 s"]),
        (["--step", "1e-13"], ["--step", "rows do not fit"]),
        (["--step", "1e-320"], ["--step", "does not advance a time of 1 s"]),
        (["--stop-time", "1e300"], ["--stop-time", "does not advance", "earlier times"]),
        (["--no-feedthrough", "nobody"], ["--no-feedthrough: nobody", "use one of gain, ramp"]),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) and value[0].startswith("--") else "",
)
def test_options(tmp_path, tiny, refused, options, words):
    refused(ssp(tmp_path, tiny), *words, options=options)


def test_allow_unmatched_lets_parameters_pass(tmp_path, tiny, monkeypatch):
    from perilune.analysis.cli import main

    monkeypatch.chdir(tmp_path)
    path = ssp(tmp_path, tiny, system(RAMP, bindings=inline("ramp.stort=Real:1; romp.x=Real:1")))
    assert main(["run", str(path), "--allow-unmatched", "--set", "a.b=1"]) == 0


def test_stop_time_that_is_missing(tmp_path, tiny, refused):
    refused(ssp(tmp_path, tiny, stop=None), "stopTime", "give --stop-time SECONDS")


def test_step_that_no_one_proposes(tmp_path, tiny, refused):
    def forget(text):
        return re.sub(r'<DefaultExperiment[^>]*stepSize="[^"]*"[^>]*/>', "", text)

    retouched(tiny / "ramp.fmu", tmp_path / "ramp.fmu", forget)
    fmu = (tmp_path / "ramp.fmu").read_bytes()
    path = ssp(tmp_path, tiny, system(RAMP), step=None, files={"resources___ramp__fmu": fmu})
    refused(path, "step", "neither the SSD nor an FMU", "give --step SECONDS")


def test_step_annotation_that_is_no_number(tmp_path, tiny, refused):
    text = document(PLAIN).replace('size="0.25"', 'size="often"')
    refused(ssp(tmp_path, tiny, files={"SystemStructure__ssd": text}), "CommunicationStep", "positive number")


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
    """One byte changed inside the compressed data of the largest file."""
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


def model_exchange(text):
    text = re.sub(r"<CoSimulation[^>]*?(/>|>)", r'<ModelExchange modelIdentifier="ramp"\1', text)
    return text.replace("</CoSimulation>", "</ModelExchange>")


BROKEN_FMUS = {
    "not a zip": (lambda tiny: b"this is no zip", ["not a readable zip", "build or copy"]),
    "empty": (lambda tiny: b"", ["not a readable zip"]),
    "truncated": (truncated, ["not a readable zip"]),
    "scrambled": (scrambled, ["zip"]),
    "no description": (lambda tiny: zipped({"a": b""}), ["modelDescription.xml", "not found"]),
    "slip": (lambda tiny: zipped(fmu_files(tiny) | {"../evil": b"x"}), ["../evil", "leaves the archive's folder"]),
    "deep slip": (lambda tiny: zipped(fmu_files(tiny) | {"a/../../evil": b"x"}), ["leaves the archive's folder"]),
    "absolute": (lambda tiny: zipped(fmu_files(tiny) | {"/tmp/evil": b"x"}), ["leaves the archive's folder"]),
    "backslash": (lambda tiny: zipped(fmu_files(tiny) | {"..\\evil": b"x"}), ["leaves the archive's folder"]),
    "drive": (lambda tiny: zipped(fmu_files(tiny) | {"C:evil": b"x"}), ["leaves the archive's folder"]),
    "doctype": (
        lambda tiny: described(tiny, lambda text: text.replace("<fmiModel", f"{DOCTYPE}<fmiModel")),
        ["modelDescription.xml: DOCTYPE"],
    ),
    "no XML": (lambda tiny: described(tiny, lambda text: text[:400]), ["not well-formed"]),
    "FMI 3": (
        lambda tiny: described(tiny, lambda text: text.replace('fmiVersion="2.0"', 'fmiVersion="3.0"')),
        ["fmiVersion", "'3.0' is not supported", "FMI 2.0"],
    ),
    "FMI 1": (lambda tiny: described(tiny, lambda text: text.replace('n="2.0"', 'n="1.0"')), ["'1.0' is not"]),
    "no value references": (
        lambda tiny: described(tiny, lambda text: re.sub(r' valueReference="\d+"', "", text)),
        ["'valueReference' is required", "and 6 more; mend the FMU"],
    ),
    "model exchange": (lambda tiny: described(tiny, model_exchange), ["CoSimulation", "not a co-simulation FMU"]),
    "other platform": (
        lambda tiny: zipped({key: value for key, value in fmu_files(tiny).items() if "linux" not in key}),
        ["binaries/", "no binary for this platform"],
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
    from perilune.analysis.errors import InputError
    from perilune.analysis.ssp.archive import open_zip

    whole = (tiny / "ramp.fmu").read_bytes()
    refusals = 0
    for k in range(200):
        data = bytearray(whole)
        data[(k * 7919 + 13) % len(data) if k % 2 else len(data) - 1 - 3 * k] ^= 1 << (k % 8)
        try:
            archive = open_zip(bytes(data), "x.fmu")
            for name in archive.namelist():
                archive.read(name)
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
    refused(path, "../evil", "leaves the archive's folder")
    assert not (tmp_path.parent / "evil").exists()
    (tmp_path / "folder").mkdir()
    refused(tmp_path / "folder", "SystemStructure.ssd", "not found")
    refused(tmp_path / "nowhere.ssp", "neither a system, a folder nor a file", "lunar_terminal_guidance")
    refused("lunar_terminal_guidence", "neither a system", "lunar_terminal_guidance")
    refused("x" * 5000, "name too long")


@pytest.mark.parametrize(
    "text", ["", "<a/>", "<ssd:x/>", "no xml", '<?xml version="1.0" encoding="klingon"?><a/>', "<a>\x00</a>"]
)
def test_descriptions_that_are_none(tmp_path, tiny, refused, text):
    refused(ssp(tmp_path, tiny, files={"SystemStructure__ssd": text}), "SystemStructure.ssd: line 1: not ")


TROUBLE = component("trouble", "trouble", "output y Real m")


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        (1, ["division", "see the FMU's message"]),
        (2, ["trouble.y is inf at t = 0.75 s"]),
        (3, ["trouble.y is nan at t = 0.75 s"]),
        (4, ["division"]),
    ],
)
def test_runs_that_fail_exit_with_1(tmp_path, tiny, refused, kind, words):
    path = ssp(tmp_path, tiny, system(TROUBLE))
    refused(path, "trouble", *words, options=["--set", f"trouble.kind={kind}"], status=1)


def test_output_that_cannot_be_written(tmp_path, tiny, capfd, monkeypatch):
    from perilune.analysis.cli import main

    monkeypatch.chdir(tmp_path)
    path = str(ssp(tmp_path, tiny))
    assert main(["run", path, "--output", "flight.xls"]) == 2
    assert re.fullmatch(r"perilune: --output: flight\.xls: neither .csv nor .parquet; .*\n", capfd.readouterr().err)
    (tmp_path / "file").write_text("")
    assert main(["run", path, "--output", "file/flight.csv"]) == 2
    error = capfd.readouterr().err
    assert ONE_LINE.fullmatch(error), error
    assert main(["run", path, "--json", str(tmp_path)]) == 2
    error = capfd.readouterr().err
    assert ONE_LINE.fullmatch(error), error


def command(*arguments, cwd):
    script = Path(sys.executable).with_name("perilune")
    return subprocess.run(
        [script, *arguments],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
        env={**os.environ, "COLUMNS": "80"},
    )


@pytest.mark.parametrize(
    ("arguments", "status"),
    [
        (["run", "broken.ssp", "--output", "out.csv"], 2),
        (["run", "trouble.ssp", "--set", "trouble.kind=1"], 1),
        (["run", "trouble.ssp", "--step", "abc"], 2),
        (["run"], 2),
        (["validate", "broken.ssp", "nowhere.ssv"], 2),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else "",
)
def test_the_real_command(tmp_path, tiny, arguments, status):
    ssp(tmp_path, tiny, system(RAMP, GAIN))
    ssp(tmp_path, tiny, system(TROUBLE), name="trouble.ssp")
    done = command(*arguments, cwd=tmp_path)
    assert done.returncode == status, done.stderr
    assert len(done.stderr.splitlines()) == (2 if "validate" in arguments else 1), done.stderr
    assert done.stderr.startswith("perilune")
    assert status == 1 or "Traceback" not in done.stderr
    assert "_seconds" not in done.stderr
    assert {entry.name for entry in tmp_path.iterdir()} == {"broken.ssp", "trouble.ssp"}
