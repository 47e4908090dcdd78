"""perilune.analysis.reports.compare.page: the numbers on the page, and what it says where something is missing.

Truth: the same numbers computed here with numpy and scipy from the parquet files; hand-written batches.
"""

import json
import math
import re
import warnings

import numpy as np
import pyarrow.parquet
import pytest
import scipy.stats

from perilune.analysis.campaigns.compare.side_by_side import compare
from perilune.analysis.reports.compare.metrics import looks_of
from perilune.analysis.reports.compare.page import write_comparison_page
from tests.support.pages.checks import assert_self_contained, data_values, parse, section_of, text_of
from tests.support.pages.comparison_samples import CAMPAIGN, DIGEST, POSITION, TARGET, VELOCITY, write_sample
from tests.support.pages.written import COMMAND

VARIANTS = ("alpha", "beta", "gamma")


def write(folders, page, reference=None):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        write_comparison_page(compare(folders, reference), page, COMMAND)
    return page.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(comparison):
    return comparison / "quiet"


@pytest.fixture(scope="module")
def page(comparison):
    return (comparison / "page.html").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def trials(folder):
    """Return columns of trials/ by variant."""
    rows = pyarrow.parquet.read_table(folder / "trials").to_pylist()
    return {
        variant: {name: np.array([row[name] for row in rows if row["variant"] == variant]) for name in rows[0]}
        for variant in VARIANTS
    }


def numbers(element):
    return [float(value) for value in element.xpath(".//data/@value")]


def table_rows(element, columns):
    """Return exact numbers of the rows of a section's tables that have ``columns`` of them."""
    actual = [numbers(row) for row in element.xpath(".//tbody/tr")]
    return [row for row in actual if len(row) == columns]


def statistics_of(values):
    """Return the statistics in a metric's row, in its order."""
    quantiles = np.quantile(values, [0.05, 0.5, 0.95, 0.99], method="inverted_cdf")
    rms = math.sqrt(np.mean(values**2))
    return [values.mean(), values.std(ddof=1), rms, values.min(), *quantiles, values.max(), len(values)]


def test_stands_alone(page):
    assert_self_contained(page)


@pytest.mark.slow
def test_same_batches_same_bytes(page, folder, tmp_path):
    assert write([folder], tmp_path / "again.html") == page


def test_rates_and_their_intervals(page, trials):
    expected = []
    for name in ("success", "metric.pinpoint"):
        for variant in VARIANTS:
            yes = int(trials[variant][name].sum())
            low = scipy.stats.beta.ppf(0.025, yes, 40 - yes + 1)
            high = scipy.stats.beta.ppf(0.975, yes + 1, 40 - yes) if yes < 40 else 1.0
            expected.append([yes / 40, low, high, yes, 40])
    np.testing.assert_allclose(table_rows(section_of(page, "Success probabilities"), 5), expected, rtol=1e-9)


def test_the_first_table_has_a_row_per_variant(page, trials):
    """Success with its interval, and the metric of success over all trials, with the worst trial against its limit."""
    expected = []
    for variant in VARIANTS:
        success, miss = trials[variant]["success"], trials[variant]["metric.miss"]
        interval = scipy.stats.binomtest(int(success.sum()), 40).proportion_ci(method="exact")
        median = np.quantile(miss, 0.5, method="inverted_cdf")
        expected.append([success.mean(), interval.low, interval.high, 40, median, miss.max()])
    (table,) = parse(page).xpath("//table[contains(@class, 'verdicts')]")
    rows = table.xpath("tbody/tr")
    np.testing.assert_allclose([numbers(row) for row in rows], expected, rtol=1e-9)
    worst = [int(np.argmax(trials[variant]["metric.miss"])) for variant in VARIANTS]
    assert [int(row.xpath("td")[-1].text_content()) for row in rows] == worst
    assert "at most 3" in table.xpath("thead")[0].text_content()
    best = [row.xpath("td[2]/b") != [] for row in rows]
    assert best == [row[0] == max(each[0] for each in expected) for row in expected]


def test_a_sentence_for_each_pair_that_differs(page, trials):
    """Truth: McNemar's and the sign test by the binomial distribution, the k-th smallest at 5 % / (n - k)."""
    tests = []
    for a, b in (("beta", "alpha"), ("gamma", "alpha"), ("gamma", "beta")):
        x, y = (trials[variant]["success"].astype(bool) for variant in (a, b))
        tests.append((scipy.stats.binomtest(int((x & ~y).sum()), int((x != y).sum())).pvalue, a, b, "success"))
        both = x & y
        less = trials[a]["metric.miss"][both] < trials[b]["metric.miss"][both]
        tests.append((scipy.stats.binomtest(int(less.sum()), int(both.sum())).pvalue, a, b, "miss"))
    expected = {}
    for rank, (p, a, b, name) in enumerate(sorted(tests)):
        if p > 0.05 / (len(tests) - rank):
            break
        expected.setdefault((a, b), set()).add(name)
    actual = {}
    for line in parse(page).xpath("//ul[@class='differences']/li"):
        pair = tuple(each.text_content().strip() for each in line.xpath("span[@class='who']"))
        actual[pair] = {name for name in ("success", "miss") if f"{name} " in line.text_content()}
    assert actual == expected
    assert expected


def test_metrics_of_the_successful_and_of_all_trials(page, trials):
    expected = []
    for chosen in (lambda actual: actual["success"], lambda actual: np.full(40, True)):
        for metric in ("miss", "propellant", "tilt", "x_error_over_sigma"):
            for variant in VARIANTS:
                values = trials[variant][f"metric.{metric}"][chosen(trials[variant])]
                expected.append(statistics_of(values))
    np.testing.assert_allclose(
        table_rows(section_of(page, "Metrics of the successful trials"), 10), expected, rtol=1e-12
    )
    tilt = trials["beta"]["metric.tilt"][trials["beta"]["success"]].mean()
    assert f">{math.degrees(tilt):.4g}</data>" in page


def test_a_quantile_printed_twice_is_one_number(tmp_path):
    """Misses without a vertical component: the metric's table and that of the ends have the same numbers."""
    write_sample(tmp_path / "out", flat=True)
    page = write([tmp_path / "out"], tmp_path / "page.html")
    metric = table_rows(section_of(page, "Metrics of the successful trials"), 10)[:3]
    ends = table_rows(section_of(page, "Ends of each variant"), 12)[:3]
    for row, end in zip(metric, ends, strict=True):
        median, most_of, largest = row[5], row[7], row[8]
        assert end[-3:] == pytest.approx([median, most_of, largest], rel=1e-12)


def test_pairs_of_rates(page, trials):
    rows = []
    for against_reference in (True, False):
        for name in ("success", "metric.pinpoint"):
            for a, b in (("beta", "alpha"), ("gamma", "alpha"), ("gamma", "beta")):
                if (b == "alpha") == against_reference:
                    x, y = (trials[variant][name].astype(bool) for variant in (a, b))
                    table = [[np.sum(x & y), np.sum(x & ~y)], [np.sum(~x & y), np.sum(~x & ~y)]]
                    discordant = table[0][1] + table[1][0]
                    p = scipy.stats.binomtest(int(table[0][1]), int(discordant)).pvalue
                    rows.append([x.mean() - y.mean(), p, table[0][0], table[0][1], table[1][0], table[1][1]])
    tree = section_of(page, "Paired comparison")
    first, others = tree.xpath(".//table")[:2]  # against the reference, and what is folded away
    actual = [numbers(row) for table in (first, others) for row in table.xpath(".//tr") if numbers(row)]
    np.testing.assert_allclose([[row[0], *row[3:]] for row in actual], rows, rtol=1e-9, atol=1e-12)
    assert all(row[1] < row[0] < row[2] for row in actual)


def test_pairs_of_metrics(page, trials):
    tree = section_of(page, "Paired comparison")
    (heading,) = (part for part in tree.xpath(".//h3") if part.text == "Metrics, trials in which both succeed")
    table = heading.getnext().xpath(".//table")[0]
    expected = []
    for metric in ("miss", "propellant", "tilt"):
        for variant in ("beta", "gamma"):
            both = trials[variant]["success"] & trials["alpha"]["success"]
            x, y = (trials[name][f"metric.{metric}"][both] for name in (variant, "alpha"))
            interval = scipy.stats.quantile_test(x - y, p=0.5).confidence_interval(0.95)
            smaller = int(np.sum(x < y))
            p = scipy.stats.binomtest(smaller, int(both.sum())).pvalue
            counts = [smaller, 0, int(np.sum(x > y)), int(both.sum())]
            expected.append([np.quantile(x - y, 0.5, method="inverted_cdf"), interval.low, interval.high, p, *counts])
    actual = [numbers(row) for row in table.xpath(".//tr") if len(numbers(row)) == 8]
    np.testing.assert_allclose(actual, expected, rtol=1e-9)


def test_intervals_without_zero_are_bold_and_others_are_not(page):
    actual = []
    for cell in section_of(page, "Paired comparison").xpath(".//td[contains(@class, 'n')]"):
        ends = numbers(cell)
        if len(ends) == 2:
            actual.append(ends[0] > 0.0 or ends[1] < 0.0)
            assert ("sure" in cell.get("class")) == actual[-1]
    assert set(actual) == {True, False}


def test_dispersions_at_the_end(page, trials):
    expected = []
    for names, target in ((POSITION, TARGET), (VELOCITY, np.zeros(3))):
        for variant in VARIANTS:
            actual = trials[variant]
            errors = np.stack([actual[f"final.{name}"] for name in names], axis=1)[actual["success"]] - target
            miss = np.linalg.norm(errors[:, :2], axis=1)
            # semi-axes of the 1-sigma ellipse are singular values of the centred points over sqrt(n - 1)
            centred = errors[:, :2] - errors[:, :2].mean(axis=0)
            axes = np.linalg.svd(centred, compute_uv=False) / math.sqrt(len(errors) - 1)
            radii = [*np.percentile(miss, [50, 99], method="inverted_cdf"), miss.max()]
            expected.append([len(errors), *errors.mean(axis=0), *errors.std(axis=0, ddof=1), *axes, *radii])
    np.testing.assert_allclose(table_rows(section_of(page, "Ends of each variant"), 12), expected, rtol=1e-9)
    assert "ellipses contain 39.3, 86.5 and 98.9 %" in text_of(page)  # test_comparison_figures.py: they do


def test_errors_over_sigma(page, trials):
    expected = []
    for variant in VARIANTS:
        values = trials[variant]["metric.x_error_over_sigma"]
        fractions = [np.mean(np.abs(values) <= limit) for limit in (1, 2, 3)]
        expected.append([values.mean(), values.std(ddof=1), *fractions, 40])
    actual = table_rows(section_of(page, "Normalised estimation errors"), 6)
    np.testing.assert_allclose(actual, expected, rtol=1e-9)
    assert "normal: 68.3" in text_of(page)


def test_every_section_and_figure_is_there(page):
    headings = [part.text for part in parse(page).xpath("//h2")]
    assert headings == [
        "Trajectories", "Distributions", "At the end", "Commands and motion over time",
        "Commands and motion, each variant", "Ends of each variant", "Normalised estimation errors",
        "Other distributions", "Success probabilities", "Metrics of the successful trials", "Paired comparison",
        "Termination status", "Dispersed parameters", "Provenance",
    ]  # fmt: skip
    quantities = [part.text for part in parse(page).xpath("//h4")]
    assert quantities == [
        "pilot.thrust", "pilot.thrust_direction above the horizontal", "ship.position[3]", "ship.velocity, magnitude",
        "ship.mass", "pilot.status", "checker.x_error_ratio",
    ]  # fmt: skip
    panels = parse(page).xpath("//*[@class='panels']//figure")
    # side, plan, end position, end velocity; metrics; quantities; errors over sigma; all variants over time, at the end
    assert len(panels) == 3 * 4 + 3 + 3 * len(quantities) + 1 + len(quantities) + 2
    assert len(parse(page).xpath("//p[@class='empty']")) == 0
    text = text_of(page)
    for name in ("downrange from the target, m", "miss <= 3", "Ships that go somewhere", DIGEST, DIGEST[::-1]):
        assert name in text
    assert COMMAND in text
    assert text.count("12 of each") == 1


def test_every_variant_has_one_colour_everywhere(folder, page):
    colours = {label: look.colour for label, look in looks_of(compare([folder])).items()}
    assert len(set(colours.values())) == 3
    seen = []
    for figure in parse(page).xpath("//*[@class='panels']/figure"):
        label = figure.xpath("figcaption")[0].text_content().strip()
        if label in colours:
            seen.append(label)
            plotted = set(re.findall(r"#[0-9a-f]{6}", " ".join(figure.xpath(".//@stroke | .//@fill")).lower()))
            assert colours[label].lower() in plotted
            assert not plotted & {colour.lower() for other, colour in colours.items() if other != label}
    assert len(seen) == 3 * 11  # paths from the side and in plan, two ends, seven quantities
    assert set(seen) == set(colours)


CASES = """[draw.case]
distribution = "grid"
values = [1, 2]
[group]
by = "case"
"""


def test_groups(tmp_path):
    """A row per contender and group; truth: the trials filtered here, two cases in turn."""
    text = CAMPAIGN.replace("[draw.offset]", f"{CASES}[draw.offset]")
    write_sample(tmp_path / "out", text=text, traced=0)
    page = write([tmp_path / "out"], tmp_path / "page.html")
    assert_self_contained(page)
    rows = pyarrow.parquet.read_table(tmp_path / "out" / "trials").to_pylist()
    rates, metrics = [], []
    for name in ("success", "metric.pinpoint"):
        for variant in VARIANTS:
            for case in (1.0, 2.0):
                actual = [row[name] for row in rows if (row["variant"], row["draw.case"]) == (variant, case)]
                interval = scipy.stats.binomtest(int(sum(actual)), 20).proportion_ci(method="exact")
                rates.append([sum(actual) / 20, interval.low, interval.high, sum(actual), 20])
    for good_only in (True, False):
        for metric in ("miss", "propellant", "tilt", "x_error_over_sigma"):
            for variant in VARIANTS:
                for case in (1.0, 2.0):
                    mine = [row for row in rows if (row["variant"], row["draw.case"]) == (variant, case)]
                    retained = [row[f"metric.{metric}"] for row in mine if row["success"] or not good_only]
                    metrics.append(statistics_of(np.array(retained)))
    tree = section_of(page, "By case")
    np.testing.assert_allclose(table_rows(tree, 5), rates, rtol=1e-9)
    np.testing.assert_allclose(table_rows(tree, 10), metrics, rtol=1e-12)
    actual = compare([tmp_path / "out"])
    assert actual.content()["group"] == "case"
    assert actual.summary["beta"].groups["2"].rates["success"].trials == 20
    assert [line.split()[:3] for line in actual.text().splitlines()[1:4]] == [
        ["alpha", "all", "40"], ["alpha", "1", "20"], ["alpha", "2", "20"],
    ]  # fmt: skip


def test_a_batch_that_says_how_to_group_is_enough(tmp_path):
    """The same draws, grouped in the second folder's campaign only, or differently."""
    plain = CASES.split("[group]")[0]
    for name, head in (("plain", plain), ("grouped", CASES), ("other", CASES.replace('by = "case"', 'by = "sort"'))):
        head += '[derive]\nsort = "3 - case"\n'
        write_sample(tmp_path / name, text=CAMPAIGN.replace("[draw.offset]", f"{head}[draw.offset]"), traced=0)
    actual = compare([tmp_path / "plain", tmp_path / "grouped"])
    assert (actual.group, actual.notes) == ("case", ())
    assert list(actual.summary["plain: beta"].groups) == ["1", "2"]
    notes = compare([tmp_path / "grouped", tmp_path / "other"]).notes
    assert notes == ("grouped and other group trials by different values: case and sort",)
    assert not compare([tmp_path / "plain"]).summary["beta"].groups


@pytest.mark.slow
def test_several_folders(folder, tmp_path):
    write_sample(tmp_path / "loud", noise=2.0)
    comparison = compare([folder, tmp_path / "loud"])
    analyses = looks_of(comparison)
    assert analyses["quiet: beta"].colour == analyses["loud: beta"].colour != analyses["loud: alpha"].colour
    assert analyses["quiet: beta"].dashes != analyses["loud: beta"].dashes == analyses["loud: alpha"].dashes
    page = write([folder, tmp_path / "loud"], tmp_path / "page.html")
    assert_self_contained(page)
    assert "6 variants" in text_of(page)
    for label in comparison.contenders:
        assert label in text_of(page)


@pytest.mark.slow
def test_reference(folder, tmp_path):
    page = write([folder], tmp_path / "page.html", "gamma")
    assert "B is gamma" in text_of(page)


def lines(page):
    return [" ".join(part.text_content().split()) for part in parse(page).xpath("//p[@class='empty']")]


def test_what_is_not_recorded_is_said_and_not_drawn(tmp_path):
    bare = CAMPAIGN[: CAMPAIGN.index("[metric.propellant]")] + CAMPAIGN[CAMPAIGN.index("[metric.tilt]") :]
    bare = bare[: bare.index("[metric.x_error")] + bare[bare.index("[record]") :]
    write_sample(tmp_path / "bare", traced=0, final=False, text=bare)
    page = write([tmp_path / "bare"], tmp_path / "page.html")
    assert_self_contained(page)
    assert lines(page) == [
        "No trajectories and no commands over time: no flight has a trace; give the campaign's [record] the keys "
        "every, signals and trials.",
        "No propellant: no metric is in kg, and [record] final does not keep a mass.",
        "No dispersion of the final position and velocity: [record] final does not keep its three elements.",
        "Nothing is recorded over time.",
        "No normalised estimation errors: no metric's name ends in _over_sigma.",
    ]


def test_of_what_goes_nowhere_no_path_and_no_propellant_are_missed(tmp_path):
    bare = CAMPAIGN[: CAMPAIGN.index("[metric.propellant]")] + CAMPAIGN[CAMPAIGN.index("[metric.tilt]") :]
    sampling = 'every = 2\nsignals = ["pilot.status"]\ntrials = 4'
    write_sample(tmp_path / "still", final=False, text=bare.replace("{sampling}", sampling))
    page = write([tmp_path / "still"], tmp_path / "page.html")
    assert_self_contained(page)
    assert lines(page) == []
    headings = [part.text for part in parse(page).xpath("//h2 | //h3")]
    assert not {"Trajectories", "At the end", "Other recorded signals"} & set(headings)
    assert "pilot.status" in [part.text for part in parse(page).xpath("//h4")]


@pytest.mark.slow
def test_propellant_from_final_masses_where_no_metric_tells_it(tmp_path):
    text = CAMPAIGN[: CAMPAIGN.index("[metric.propellant]")] + CAMPAIGN[CAMPAIGN.index("[metric.tilt]") :]
    write_sample(tmp_path / "mass", text=text)
    page = write([tmp_path / "mass"], tmp_path / "page.html")
    assert "final ship.mass" in text_of(page)
    assert not lines(page)


@pytest.mark.parametrize(
    "options",
    [
        pytest.param({"trials": 1}, marks=pytest.mark.slow),
        pytest.param({"trials": 2, "traced": 1}, marks=pytest.mark.slow),
        pytest.param({"variants": ("default",)}, marks=pytest.mark.slow),
        pytest.param(
            {"variants": tuple(f"guidance_{k}" for k in range(9)), "trials": 8, "traced": 3}, marks=pytest.mark.slow
        ),
        pytest.param({"noise": 100.0}, marks=pytest.mark.slow),  # no trial succeeds
        pytest.param({"noise": 0.0}, marks=pytest.mark.slow),  # no dispersion at all
        pytest.param({"targets": False}, marks=pytest.mark.slow),
        pytest.param({"variants": ("$x_1$ <b>&", "y/z")}, marks=pytest.mark.slow),
        {"variants": ("$x_1$ <b>&",)},
        pytest.param({"trials": 3000, "traced": 1, "variants": ("a", "b")}, marks=pytest.mark.slow),
    ],
    ids=[
        "one trial",
        "two trials",
        "one variant",
        "many variants",
        "failures",
        "exact",
        "no target",
        "names",
        "one name",
        "many",
    ],
)
def test_extremes(tmp_path, options):
    write_sample(tmp_path / "out", **options)
    page = write([tmp_path / "out"], tmp_path / "page.html")
    assert_self_contained(page)
    assert len(page) < 4_000_000
    if "$x_1$ <b>&" in options.get("variants", ()):
        assert "$x_1$ <b>&" in text_of(page)
        assert not parse(page).xpath("//b[contains(text(), 'x_1')]")
    if options.get("targets") is False:
        assert "no parameter of the system is called target_position" in text_of(page)


@pytest.mark.slow
def test_metrics_that_are_not_finite(tmp_path):
    """A flight that fails has no metrics: it counts as a failure and drops out of the rest."""
    result = write_sample(tmp_path / "out")
    for trials in result.trials.values():
        for values in (*trials.metrics.values(), *trials.final.values()):
            values[::5] = np.nan
        trials.metrics["tilt"][1::5] = np.inf
        trials.success[::5] = False
    repeated = type(result)(result.plan, result.trials, result.provenance)
    repeated.write(tmp_path / "out")
    page = write([tmp_path / "out"], tmp_path / "page.html")
    assert_self_contained(page)
    assert "without an end" in page


@pytest.mark.slow
def test_traces_of_failures_only_are_called_biased(tmp_path):
    result = write_sample(tmp_path / "out")
    result.provenance["record"] = {"every": None, "signals": [], "trials": None, "traces": "failures"}
    for trials in result.trials.values():
        for trial in [trial for trial in trials.traces if trials.success[trial]]:
            del trials.traces[trial]
    result.write(tmp_path / "other")
    from perilune.analysis.campaigns.folder.files import write_draws

    write_draws(result.plan, tmp_path / "other", 50)
    page = write([tmp_path / "other"], tmp_path / "page.html")
    assert "do not compare their spread" in text_of(page)
    assert "pilot.thrust_direction above the horizontal" in text_of(page)
    assert "pilot.status" not in [part.text for part in parse(page).xpath("//h4")]  # not among what is known by name


def test_document_is_json_and_has_the_pages_numbers(folder, page):
    document = compare([folder]).content()
    json.dumps(document, allow_nan=False)
    values = set(data_values(page))
    for entry in document["variants"].values():
        for rate in entry["rates"].values():
            assert {repr(number) for number in (rate["count"], rate["rate"], *rate["interval"])} <= values
    for pair in document["pairs"]:
        for rate in pair["rates"].values():
            assert {repr(rate[key]) for key in ("both", "only_a", "only_b", "neither", "difference")} <= values
        for name in ("miss", "propellant", "tilt"):
            for table in ("metrics", "metrics_all"):
                assert repr(pair[table][name]["median"]) in values
