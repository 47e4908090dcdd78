"""Page of a comparison: sections and figures, colours, several folders, extreme batches, JSON.

Truth: hand-written batches; the numbers of the JSON document.
"""

import json
import re

import numpy as np
import pytest

from perilune.analysis.campaigns.compare.side_by_side import compare
from perilune.analysis.documents.of.comparison.variant_distributions import looks_of
from tests.support.campaigns.trial_tables import changed
from tests.support.pages.checks import assert_self_contained, data_values, parse, text_of
from tests.support.pages.comparison_samples import DIGEST, write_sample
from tests.support.pages.written import COMMAND, write_comparison_page


def test_stands_alone(page):
    assert_self_contained(page)


@pytest.mark.slow
def test_same_batches_same_bytes(page, folder, tmp_path):
    assert write_comparison_page([folder], tmp_path / "again.html") == page


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
    assert text.count("Not judged: no requirements declared") == 1
    assert text.count("they contain 98.9 % of a bivariate normal distribution") == 1
    assert "points to the farthest trial or ellipse outside of the panel" in text
    assert "Command of each compared batch" not in text  # without manifests


def test_every_variant_has_one_colour_everywhere(folder, page):
    colours = {label: look.colour for label, look in looks_of(compare([folder])).items()}
    assert len(set(colours.values())) == 3
    observed = []
    for figure in parse(page).xpath("//*[@class='panels']/figure"):
        label = figure.xpath("figcaption")[0].text_content().strip()
        if label in colours:
            observed.append(label)
            plotted = set(re.findall(r"#[0-9a-f]{6}", " ".join(figure.xpath(".//@stroke | .//@fill")).lower()))
            assert colours[label].lower() in plotted
            assert not plotted & {colour.lower() for other, colour in colours.items() if other != label}
    assert len(observed) == 3 * 11  # paths from the side and in plan, two ends, seven quantities
    assert set(observed) == set(colours)


@pytest.mark.slow
def test_several_folders(folder, tmp_path):
    write_sample(tmp_path / "loud", noise=2.0)
    comparison = compare([folder, tmp_path / "loud"])
    analyses = looks_of(comparison)
    assert analyses["quiet: beta"].colour == analyses["loud: beta"].colour != analyses["loud: alpha"].colour
    assert analyses["quiet: beta"].dashes != analyses["loud: beta"].dashes == analyses["loud: alpha"].dashes
    page = write_comparison_page([folder, tmp_path / "loud"], tmp_path / "page.html")
    assert_self_contained(page)
    assert "6 variants" in text_of(page)
    for label in comparison.contenders:
        assert label in text_of(page)


@pytest.mark.slow
def test_reference(folder, tmp_path):
    page = write_comparison_page([folder], tmp_path / "page.html", "gamma")
    assert "B is gamma" in text_of(page)


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
    page = write_comparison_page([tmp_path / "out"], tmp_path / "page.html")
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
    for variant, trials in result.trials.items():
        columns = {}
        for name in trials.names:
            if name.startswith(("metric.", "final.")):
                columns[name] = np.array(trials.column(name), dtype=float)
                columns[name][::5] = np.nan
        columns["metric.tilt"][1::5] = np.inf
        success = np.array(trials.success)
        success[::5] = False
        result.trials[variant] = changed(trials, columns | {"success": success})
    result.write(tmp_path / "out")
    page = write_comparison_page([tmp_path / "out"], tmp_path / "page.html")
    assert_self_contained(page)
    assert "without an end" in page


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
