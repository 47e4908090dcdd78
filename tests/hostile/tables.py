"""Tables of inputs over time (CSV) and of draws (Parquet) that lie, are ragged or too large."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from tests.support.builders import document, pack, system
from tests.support.refused import GAIN

from .campaigns import GOOD, campaign_file
from .case import Case, Content, Write, put

CSV, PARQUET = "hostile.csv", "hostile.parquet"
RUN = f"run good.ssp --input {CSV} --open-inputs start --output out/x.csv"
BATCH = f"batch good.ssp --campaign hostile.toml --draws {PARQUET} --output out"
DRAW = "ramp.slope"


def series(content: Content) -> Write:
    """Return a writer of inputs over time and a system that takes one, gain.u."""

    def write(folder: Path, fmus: Path) -> None:
        pack(folder / "good.ssp", fmus, document(system(GAIN)))
        put(CSV, content)(folder, fmus)

    return write


def draws(make: Callable[[], bytes]) -> Write:
    """Return a writer of draws and a campaign that takes them."""

    def write(folder: Path, fmus: Path) -> None:
        campaign_file(GOOD)(folder, fmus)
        (folder / PARQUET).write_bytes(make())

    return write


def table(**columns: object) -> bytes:
    content = io.BytesIO()
    pyarrow.parquet.write_table(
        pyarrow.table({name.replace("__", "."): each for name, each in columns.items()}), content
    )
    return content.getvalue()


def repeated(rows: int, columns: int = 1) -> bytes:
    """Return ``rows`` equal rows, which take no space."""
    values = pyarrow.array(np.zeros(min(rows, 10**6)))
    content = io.BytesIO()
    names = [DRAW, *(f"a{n}" for n in range(1, columns))]
    with pyarrow.parquet.ParquetWriter(content, pyarrow.schema([(name, pyarrow.float64()) for name in names])) as file:
        for _ in range(max(1, rows // 10**6)):
            file.write_table(pyarrow.table([values] * columns, names=names))
    return content.getvalue()


SERIES: dict[str, tuple[Content, tuple[str, ...]]] = {
    "empty": ("", ("empty",)),
    "NULs": (b"\0" * 1000, (CSV,)),
    "a NUL in a number": ("time,gain.u\n0,1\0\n", ("line 2", "gain.u")),
    "not UTF-8": (b"time,gain.u\n0,\xff\xfe\n", ("not a CSV file",)),
    "a ragged row": ("time,gain.u\n0,1\n1,2,3\n", ("line 3", "3 numbers")),
    "a row less": ("time,gain.u\n0,1\n1\n", ("line 3", "1 numbers")),
    "an open quote": (lambda: 'time,gain.u\n0,"1\n' + "1,2\n" * 100_000, (CSV,)),
    "a field of 10^6": (f"time,gain.u\n0,{'1' * 1_000_000}\n", (CSV,)),
    "a header of 10^5 columns": (
        lambda: f"time,{','.join(f'a{n}' for n in range(100_000))}\n0{',0' * 100_000}\n",
        ("a0",),
    ),
    "a header of 10^5 equal columns": (f"time{',a' * 100_000}\n", ("column a", "twice")),
    "a header with escapes": ("time,\x1b[2J\x1b]0;x\x07\u202e\n0,1\n", (r"\x1b[2J", "no such input")),
    "a header that is a formula": ("time,=cmd()\n0,1\n", ("=cmd()", "no such input")),
    "a header that is a line": ('time,"gain.u\nperilune: OK"\n0,1\n', ("no such input",)),
    "an escape in a number": ("time,gain.u\n0,\x1b[2J1\n", ("line 2", r"\x1b[2J1")),
    "a formula in a number": ("time,gain.u\n0,=1+1\n", ("line 2", "=1+1")),
    "nan": ("time,gain.u\n0,nan\n", ("line 2", "gain.u", "not finite")),
    "an infinite number": ("time,gain.u\n0,1e400\n", ("line 2", "gain.u", "not finite")),
    "a time of nan": ("time,gain.u\nnan,1\n", ("line 2", "time", "not finite")),
    "a time that falls": ("time,gain.u\n1,1\n0,1\n", ("line 3", "time falls")),
    "times of +-1.7e308": ("time,gain.u\n-1.7e308,1\n1.7e308,2\n", (CSV,)),
    "a Parquet file": (repeated(10), ("not a CSV file",)),
    "10^6 lines of nothing": (lambda: "time,gain.u\n" + "\n" * 1_000_000, ("no samples",)),
    "10^7 empty fields": (lambda: "time,gain.u\n" + "," * 10_000_000, ("line 2",)),
    "a byte order mark twice": ("\ufeff\ufefftime,gain.u\n0,1\n", ("first column",)),
}
CASES = {f"inputs: {name}": Case(series(content), (RUN,), (CSV, *words)) for name, (content, words) in SERIES.items()}
DRAWS: dict[str, tuple[Callable[[], bytes], tuple[str, ...]]] = {
    "empty": (lambda: b"", (PARQUET,)),
    "no Parquet": (lambda: b"PAR1" + b"\xff" * 1000 + b"PAR1", (PARQUET, "not Parquet")),
    "a footer of 2 GB": (lambda: b"PAR1" + b"\xff\xff\xff\x7fPAR1", (PARQUET,)),
    "truncated": (lambda: repeated(1000)[:-100], (PARQUET,)),
    "no rows": (lambda: table(ramp__slope=pyarrow.array([], pyarrow.float64())), ("no row",)),
    "texts": (lambda: table(ramp__slope=["1", "2"]), (DRAW, "not a column of numbers")),
    "lists": (lambda: table(ramp__slope=[[1.0], [2.0]]), (DRAW, "not a column of numbers")),
    "nothing": (lambda: table(ramp__slope=[1.0, None]), (DRAW,)),
    "nan": (lambda: table(ramp__slope=[float("nan")]), (DRAW, "row 0")),
    "inf": (lambda: table(ramp__slope=[float("inf")]), (DRAW, "row 0")),
    "dates": (lambda: table(ramp__slope=pyarrow.array([0], pyarrow.timestamp("s"))), (DRAW,)),
    "bytes": (lambda: table(ramp__slope=[b"\x00"]), (DRAW, "not a column of numbers")),
    "a column twice": (lambda: written(pyarrow.table([pyarrow.array([1.0])] * 2, names=[DRAW, DRAW])), (DRAW,)),
    "a header with escapes": (lambda: table(**{DRAW: [1.0], "\x1b[2J\u202e": [1.0]}), (r"\x1b[2J\u202e",)),
    "a stream of 1e300": (lambda: table(**{DRAW: [1.0], "streams_of": [1e300]}), ("streams_of",)),
    "a negative stream": (lambda: table(**{DRAW: [1.0], "streams_of": [-1.0]}), ("streams_of",)),
    "a name that is not UTF-8": (
        lambda: table(ramp__slope=[1.0]).replace(DRAW.encode(), b"ramp.slop\xff"),
        (PARQUET, "not Parquet"),
    ),
    "5 x 10^7 rows": (lambda: repeated(50_000_000), (PARQUET, "rows")),
    "10^4 columns": (lambda: repeated(10, 10_000), ("a1",)),
}


def written(content: pyarrow.Table) -> bytes:
    target = io.BytesIO()
    pyarrow.parquet.write_table(content, target)
    return target.getvalue()


CASES |= {f"draws: {name}": Case(draws(make), (BATCH,), (PARQUET, *words)) for name, (make, words) in DRAWS.items()}
