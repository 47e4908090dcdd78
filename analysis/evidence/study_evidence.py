"""Studies as evidence: campaigns with their verdicts, stability studies with their margins, repeated and compared."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import chdir
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ...common.errors import InputError
from ...common.visible import limit_lines
from ...fmus_src.evidence.manifest import STABILITY
from ..campaigns.definition.plan import read_plan
from ..campaigns.execute.campaign_result import CampaignResult
from ..campaigns.execute.loaded_campaign import open_campaign
from ..campaigns.execute.runner import fly_campaign
from ..commands.stability import study_command
from ..runtime.ssp.archive import SystemArchive
from ..runtime.ssp.ssd_reader import read_description
from ..runtime.system.options import SystemOptions, Watch
from ..stability.request.loop_declaration import read_declaration
from ..stability.request.request import read_request
from ..stability.results.document import document
from ..stability.study import study

ALL = "all"
MARGINS = ("gain_margin_db", "phase_margin_deg", "modulus_margin", "disk_margin", "delay_margin_s")
KEYS = ("name", "point", "verdict", "stable", *MARGINS)
LAPACK = 1e-6  # relative tolerance of margins, whose last bits depend on the linear algebra library
NAMED = 6


def known_studies(archive: SystemArchive) -> list[str]:
    """Return the studies of a system: its campaigns by name, and `STABILITY` if it declares loops."""
    if archive.is_fmu:
        return []
    has_loops = bool(read_declaration(read_description(archive)).loops)
    return [*sorted(archive.campaign_names()), *([STABILITY] if has_loops else [])]


def make_report(system: Path, name: str, options: SystemOptions, timeout: float | None = None) -> bytes:
    """Return the JSON report of a ``study``: a campaign's name, or `STABILITY`. Raises InputError for an unknown study.

    ``timeout`` (s, wall clock) limits each trial of a campaign; a stability study has no limit.
    """
    report = _margins(system, options) if name == STABILITY else _verdicts(system, name, options, timeout)
    return f"{json.dumps({'perilune': version('perilune'), **report}, indent=1)}\n".encode()


def compare_report(
    stored: bytes, system: Path, name: str, options: SystemOptions, file: str, timeout: float | None
) -> list[str]:
    """Return the differences between a repeated study and its stored report, one line each. Raises InputError."""
    try:
        numbers = dict(_iterate_scalars(json.loads(stored), ""))
    except (ValueError, RecursionError) as error:
        raise InputError(file, "", f"not JSON: {error}", "export the system again") from error
    now = dict(_iterate_scalars(json.loads(make_report(system, name, options, timeout)), ""))
    relative = LAPACK if name == STABILITY else 0.0
    differences = [
        f"{key}: {numbers.get(key, 'absent')} in the report, {now.get(key, 'absent')} now"
        for key in {**numbers, **now}
        if key != ".perilune" and not _same(numbers.get(key), now.get(key), relative)
    ]
    return [f"{name}: {line}" for line in limit_lines(differences, NAMED)]


def _verdicts(system: Path, name: str, options: SystemOptions, timeout: float | None) -> dict[str, object]:
    plan = read_plan(system, name, options, watch=Watch(timeout))
    with chdir(Path.cwd()):  # an FMU may change the folder
        campaign = open_campaign(plan, None)
        content = CampaignResult.finish(campaign, fly_campaign(campaign, campaign.missing())).content()
    return {"campaign": name, **{key: content[key] for key in ("trials", "seed", "success", "metrics", "variants")}}


def _margins(system: Path, options: SystemOptions) -> dict[str, object]:
    content: dict[str, Any] = document(study(read_request(system, options), study_command))
    loops = [{key: loop[key] for key in KEYS if key in loop} for loop in content["loops"]]
    return {"verdict": content["verdict"], "limits": content["limits"], "loops": loops}


def _iterate_scalars(entry: object, path: str) -> Iterator[tuple[str, object]]:
    """Yield every scalar of a JSON document with its path."""
    if isinstance(entry, Mapping):
        for key, inner in entry.items():
            yield from _iterate_scalars(inner, f"{path}.{key}")
    elif isinstance(entry, list):
        for index, inner in enumerate(entry):
            yield from _iterate_scalars(inner, f"{path}[{index + 1}]")
    else:
        yield path, entry


def _same(before: object, after: object, relative: float) -> bool:
    if isinstance(before, float) and isinstance(after, float):
        return before == after or math.isclose(before, after, rel_tol=relative, abs_tol=0.0)
    return before == after
