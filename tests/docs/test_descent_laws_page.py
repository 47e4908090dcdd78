"""Tables of docs/systems/descent_laws.md equal the results of the commands above them.

Truth: the campaigns, whose means are computed here by numpy. `make test` simulates two rows with short descents, `make
long` all.
"""

import re

import numpy as np
import pytest

import perilune
from perilune.common.paths import ROOT
from tests.support.lengths import LONG, either

PAGE = (ROOT / "docs" / "systems" / "descent_laws.md").read_text(encoding="utf-8")
BENCH = re.compile(r"```sh\n(perilune batch lunar_landing .*)\n```\n\n(\|.*\n)\|[ -|]*\n((?:\|.*\n)+)")
SHORT = [("laws_approach", "zem_zev_guidance"), ("laws_approach", "apollo_guidance")]
MEANS = {  # of the successful
    "propellant, kg": "propellant",
    "time, s": "flight_time",
    "position, m": "aim_error",
}
MINIMUM = {  # of all
    "least margin to the cone, m": "glide_margin",
    "least cosine of tilt": "least_upright",
}
EXCESS = "excess mean, largest, %"
BY_DISTANCE = "propellant, kg: 300, 1000, 2000 m"


def columns_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


ROWS = [
    pytest.param(words, dict(zip(columns_of(header), columns_of(line), strict=True)), id=f"{words[4]} {law}")
    for words, header, body in [(command.split(), *table) for command, *table in BENCH.findall(PAGE)]
    for line in body.splitlines()
    for law in [columns_of(line)[0].strip("`")]
    if LONG or (words[4], law) in SHORT
]  # fmt: skip


def fly(words, law):
    campaign = words[4]
    choice = (
        {"configuration": law} if campaign in ("laws_approach", "laws_divert") else {"compare": {"guidance": [law]}}
    )
    (actual,) = perilune.batch("lunar_landing", campaign, **choice).trials.values()
    return actual


def expected_cells(actual):
    """Yield the columns of a row, as sequences of numbers; none where no trial succeeded."""
    success, metrics = actual.success, actual.metrics
    rate, pinpoint = 100.0 * np.mean(success), 100.0 * np.mean(metrics["pinpoint"])
    yield "success, pinpoint, %", [rate, pinpoint]
    yield "pinpoint, %", [pinpoint]
    for column, metric in MEANS.items():
        yield column, [np.mean(metrics[metric][success])] if success.any() else []
    if "excess" in metrics:
        excess = metrics["excess"][success]
        yield EXCESS, [np.mean(excess), np.max(excess)] if excess.size else []
    for column, metric in MINIMUM.items():
        if metric in metrics:
            yield column, [np.min(metrics[metric])]
    groups = [success & (np.arange(len(success)) % 3 == i) for i in range(3)]  # a grid varies from trial to trial
    yield BY_DISTANCE, [np.mean(metrics["propellant"][group]) for group in groups if group.any()]


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(("words", "row"), either(ROWS, ROWS[:2]))
def test_a_row_is_what_its_command_gives(words, row):
    expected = dict(expected_cells(fly(words, row["law"].strip("`"))))
    for column, text in row.items():
        if column == "law":
            continue
        numbers = text.split(", ") if text else []
        assert len(numbers) == len(expected[column]), column
        for number, value in zip(numbers, expected[column], strict=True):
            decimals = len(number.partition(".")[2])
            assert float(number) == pytest.approx(value, abs=0.501 * 10.0**-decimals), column


@pytest.mark.skipif(not LONG, reason="120 flights")
@pytest.mark.usefixtures("fmus")
def test_a_longer_last_burn_of_convex_plans():
    for last_burn, velocity, pinpoint in ((2.0, 1.04, 59), (3.0, 0.44, 60)):
        (actual,) = perilune.batch(
            "lunar_landing",
            "laws_braking",
            trials=60,
            compare={"guidance": ["convex_guidance"]},
            set={"guidance.last_burn": last_burn},
        ).trials.values()
        assert f"{velocity} m/s" in PAGE
        assert np.max(actual.metrics["velocity_error"]) == pytest.approx(velocity, abs=0.00501)
        assert np.sum(actual.metrics["pinpoint"]) == pinpoint


def test_every_command_has_its_table():
    assert len(BENCH.findall(PAGE)) == PAGE.count("--campaign laws_") == 5


def test_what_to_choose_has_the_excess_of_the_tables():
    """The first numbers of that column, one for each bench; a dash where a law has none."""
    text = (ROOT / "docs" / "choosing.md").read_text(encoding="utf-8")
    header, body = re.search(r"(\| FMU .*propellant above the bound.*\n)\|[ -|]*\n((?:\|.*\n)+)", text).groups()
    benches = re.findall(r"`(laws_\w+)`", header)
    means = {bench: {} for bench in benches}
    for command, head, rows in BENCH.findall(PAGE):
        for line in rows.splitlines():
            row = dict(zip(columns_of(head), columns_of(line), strict=True))
            if EXCESS in row:
                means[command.split()[4]][row["law"]] = row[EXCESS].partition(",")[0]
    for line in body.splitlines():
        law, *_, excess = columns_of(line)
        assert excess == ", ".join(means[bench].get(law) or "-" for bench in benches), law
