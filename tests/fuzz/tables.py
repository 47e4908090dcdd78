"""Tables, mappings, expressions and archives that were changed: accepted, or refused in one line."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.definition.expressions import Expression
from perilune.analysis.campaigns.definition.file import read_campaign
from perilune.analysis.campaigns.draws.supplied import read_supplied
from perilune.analysis.runtime.ssp.documents import read_document
from perilune.analysis.runtime.ssp.parameter_sets import apply_mapping, read_parameter_file
from perilune.analysis.runtime.system.series import read_series
from perilune.common.zips import ZippedFiles
from tests.fuzz.changes import JUNK, changed_xml, flipped, flipped_bytes
from tests.fuzz.documents import Target, check, make_archive, reads
from tests.fuzz.originals import CAMPAIGN, SERIES, SSM, SSV

COLUMNS = ("ramp.slope", "ramp.flag_at", "one", "two", "streams_of", "streams_of.ramp", "trial", "twice")
ARRAYS = st.sampled_from(
    [
        *(pyarrow.array(values) for values in ([0.5, None], [True, None], ["a", "b"], [b"\xff", b""], [[1], []])),
        *(pyarrow.array(values) for values in ([0.0, np.nan], [1e400, 1.0], [2**63 - 1, -(2**63)], [None, None])),
        *(pyarrow.array([1, 0]).cast(kind) for kind in ("uint8", "int32", "timestamp[s]", "float16")),
        pyarrow.array([{"a": 1}, {"a": 2}]),
        pyarrow.array([1.0, 1.0]).dictionary_encode(),
    ]
)
OPERATIONS = ("+", "-", "*", "/", "//", "%", "<", "==", " and ", " or ", "not ", " if x else ", ", ", "(", ")", ".")
OPERANDS = ("x", "min(", "where(", "norm(", "abs(x)", "1e308", "x[0]", "pi", "\n", "\0", "\\", "é")
TOKENS = st.sampled_from([*OPERANDS, *OPERATIONS, "**"])


def parquet(columns: dict[str, object]) -> bytes:
    """Return a table as a file."""
    content = io.BytesIO()
    pyarrow.parquet.write_table(pyarrow.table(columns), content)
    return content.getvalue()


def any_series(_fmus: Path, folder: Path) -> Target:
    """Test inputs over time with a cell, or a bit, changed."""
    path = folder / "hostile.csv"
    entries = [line.split(",") for line in SERIES.splitlines()]

    @st.composite
    def changed_cells(draw: st.DrawFn) -> bytes:
        rows = [list(row) for row in entries]
        for _ in range(draw(st.integers(1, 3))):
            row = draw(st.sampled_from(rows))
            row[draw(st.integers(0, len(row) - 1))] = draw(JUNK | st.text(max_size=4))
        return "\n".join(map(",".join, rows)).encode(errors="surrogatepass")

    def read(content: bytes) -> None:
        path.write_bytes(content)
        read_series(path)

    return reads(changed_cells() | flipped(SERIES), read)


def any_draws(_fmus: Path, folder: Path) -> Target:
    """Test draws with other columns, or a bit of the file changed."""
    (folder / "good.toml").write_text(CAMPAIGN)
    campaign = read_campaign(folder / "good.toml")
    path = folder / "hostile.parquet"
    good: dict[str, object] = {name: pyarrow.array([1.0, 0.0]) for name in COLUMNS[:5]}
    changed = st.dictionaries(st.sampled_from(COLUMNS) | st.text(max_size=4), ARRAYS, max_size=3)

    def read(content: bytes) -> None:
        path.write_bytes(content)
        read_supplied(path, campaign)

    return reads(changed.map(lambda columns: parquet(good | columns)) | flipped_bytes(parquet(good)), read)


def any_mapping(_fmus: Path, _folder: Path) -> Target:
    """Test a mapping of a parameter set with a change."""
    values = read_parameter_file(SSV.encode(), "a.ssv")

    def read(content: bytes) -> None:
        apply_mapping(values, read_document(content, "ssm", "a.ssm"), "a.ssm")

    return reads(changed_xml(SSM) | flipped(SSM), read)


def any_expression(_fmus: Path, _folder: Path) -> Target:
    """Test an expression of any tokens, evaluated where it is one."""

    @given(text=st.lists(TOKENS | JUNK.filter(lambda text: "**" not in text), max_size=12).map("".join))
    def change(text: str) -> None:
        def read() -> None:
            Expression(text, ("a.toml", "success")).evaluate({"x": np.array([0.0, 1.0, np.nan])})

        check(read)

    return change


def any_archive(fmus: Path, folder: Path) -> Target:
    """Test an archive with bits changed, of its last 4 kB above all, where its directory is."""
    packed = make_archive(fmus, folder).path.read_bytes()
    tail = flipped_bytes(packed[-4096:]).map(lambda end: packed[:-4096] + end)

    return reads(tail | flipped_bytes(packed), lambda content: dict(ZippedFiles(content, "a.ssp")))
