"""Folders of campaigns, with something changed in their manifests or their shards."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from perilune.analysis.campaigns.execute.loaded_campaign import LoadedCampaign, open_folder
from perilune.analysis.campaigns.execute.runner import merge_rows
from perilune.analysis.campaigns.folder.campaign_manifest import FILE
from perilune.analysis.cli import main
from perilune.common.errors import InputError

MOST_BITS = 3
JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(allow_nan=False),
    st.text(max_size=8),
    st.lists(st.integers(), max_size=2),
    st.dictionaries(st.text(max_size=3), st.integers(), max_size=2),
)


def make_folder(folder: Path) -> Path:
    """Write a good folder, of two shards of 25 trials."""
    words = ["batch", "lunar_terminal_guidance", "--campaign", "paper", "--configuration", "analytic_guidance"]
    assert main([*words, "--trials", "50", "--stop-time", "5", "--output", str(folder)]) == 0
    return folder


def merge(folder: Path) -> str | None:
    """Return None, or the one line of the refusal."""
    return refusal(lambda: merge_campaign(open_folder(folder)))


def merge_campaign(campaign: LoadedCampaign) -> None:
    """Read all trials of a campaign. Raises InputError."""
    for rows in merge_rows(campaign).values():
        rows.whole()


def refusal(read: Callable[[], object]) -> str | None:
    """Return None, or the one line of the InputError."""
    try:
        read()
    except InputError as error:
        line = str(error)
        assert "\n" not in line
        assert ";" in line
        return line
    return None


def paths_in(document: Any, path: tuple[Any, ...] = ()) -> Any:
    """Yield the path to every value of a document."""
    yield path
    if isinstance(document, dict):
        items = document.items()
    else:
        items = enumerate(document) if isinstance(document, list) else ()
    for key, inner in items:
        yield from paths_in(inner, (*path, key))


@st.composite
def changed_json(draw: Any, document: Any) -> Any:
    """Draw the document with one value changed, or gone."""
    changed = copy.deepcopy(document)
    path = draw(st.sampled_from([path for path in paths_in(document) if path]))
    inner = changed
    for key in path[:-1]:
        inner = inner[key]
    if draw(st.booleans()) or not isinstance(inner, dict):
        inner[path[-1]] = draw(JUNK)
    else:
        del inner[path[-1]]
    return changed


def any_manifest(folder: Path) -> Callable[[], None]:
    """Test opening and merging a good folder, which it changes, with other manifests."""
    document = json.loads((folder / FILE).read_text())

    @given(changed_json(document))
    def check(changed: Any) -> None:
        (folder / FILE).write_text(json.dumps(changed))
        merge(folder)

    return check


def any_shard(folder: Path) -> Callable[[], None]:
    """Test merging a good folder, which it changes, with bits of a shard flipped."""
    campaign = open_folder(folder)
    path = folder / "trials" / "000000.parquet"
    content = path.read_bytes()

    @given(st.lists(st.integers(0, 8 * len(content) - 1), min_size=1, max_size=MOST_BITS))
    def check(flipped: list[int]) -> None:
        changed = bytearray(content)
        for bit in flipped:
            changed[bit // 8] ^= 1 << bit % 8
        path.write_bytes(changed)
        refusal(lambda: merge_campaign(campaign))

    return check
