"""The TOML file of a synthesis.

Truth: the documented keys; every error in one line that names the file and the place; equal keys and defaults in the
reference of keys and in the settings.
"""

import re
from dataclasses import asdict

import pytest

from docs.reference.formats.pages import format_pages
from perilune.analysis.campaigns.definition.file import read_campaign
from perilune.analysis.design.laws.law import find_law, read_law
from perilune.analysis.design.synthesis.search_settings import SearchSettings
from perilune.analysis.design.synthesis.synthesis_file import LIMITS, read_synthesis
from perilune.common.errors import InputError
from perilune.common.paths import LAWS
from tests.support.documented import page_text
from tests.support.laws.campaign_text import CAMPAIGN, TEXT

DOCS = page_text("docs/synthesis.md")


def read(tmp_path, text):
    path = tmp_path / "search.toml"
    path.write_text(text)
    return read_synthesis(path)


def test_a_file_as_it_should_be(tmp_path):
    actual = read(tmp_path, TEXT)
    assert actual.campaign.trials == 4
    assert actual.component == "guidance"
    assert actual.fmu is None
    assert actual.basic == read_law(find_law("diveev_2013_basic"))
    assert (actual.step, actual.stop_time) == (0.5, 320.0)
    assert (actual.settings.population, actual.settings.mutation) == (8, 0.7)
    assert list(actual.objectives) == ["altitude", "speed"]
    plan = actual.plan(5)
    assert plan.campaign.seed == 5
    assert plan.options.chosen["step"] == 0.5
    assert len(plan.overlaid) == 256 + 3 + 1
    with_fmu = read(tmp_path, TEXT.replace("[network_operator]\n", '[network_operator]\nfmu = "other"\n'))
    assert with_fmu.plan().options.use == {"guidance": "other"}


def test_published_numbers_are_the_defaults():
    published = {"population": 256, "generations": 64, "crossovers": 128, "variations": 8, "elites": 8}
    published |= {"mutation": 0.7, "crossover": 0.4, "renewal": 29, "integer_bits": 4, "fraction_bits": 12}
    assert asdict(SearchSettings()) == published | {"stop": True}


def test_every_key_is_documented_with_its_default_and_range():
    page = format_pages()["search.md"]
    for name, default in asdict(SearchSettings()).items():
        (row,) = re.findall(rf"^\| `{name}` .*\|$", page, re.MULTILINE)
        assert f"| {str(default).lower()} |" in row
        if name in LIMITS:
            low, high = LIMITS[name]
            assert f"{low:g} to {high:g}" in row
    for name in ("component", "fmu", "law", "step", "stop_time", "objectives"):
        assert re.search(rf"^\|.*`{name}`.* \|", page, re.MULTILINE)


def test_the_example_in_the_docs_is_a_synthesis(tmp_path):
    (example,) = re.findall(r"```toml\n(.*?)```", DOCS, re.DOTALL)
    actual = read(tmp_path, example)
    assert actual.settings == SearchSettings()


@pytest.mark.parametrize("path", sorted(LAWS.glob("searches/*.toml")), ids=lambda path: path.stem)
def test_the_searches_of_this_repository(path):
    actual = read_synthesis(path)
    assert path.stem.startswith(actual.campaign.system)
    assert actual.settings == SearchSettings()
    assert list(actual.objectives) == ["altitude", "speed"]


def test_a_law_beside_the_file(tmp_path):
    (tmp_path / "mine.json").write_text(find_law("diveev_2013").read_text())
    actual = read(tmp_path, TEXT.replace("diveev_2013_basic", "mine.json"))
    assert actual.basic == read_law(find_law("diveev_2013"))


def changed(old, new):
    assert old in TEXT
    return TEXT.replace(old, new)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (CAMPAIGN, "network_operator: missing"),
        (changed("population", "populatoin"), "network_operator.populatoin: unknown key"),
        (changed("population = 8", "population = 8.0"), "network_operator.population: 8.0 is not a whole number"),
        (changed("population = 8", "population = 1"), "network_operator.population: 1 is out of range; give 2 to 5000"),
        (changed("generations = 3", "generations = 0"), "generations: 0 is out of range"),
        (changed("crossovers = 6", "crossovers = 0"), "crossovers: 0 is out of range"),
        (changed("variations = 4", "variations = 0"), "variations: 0 is out of range"),
        (changed("renewal = 2", "renewal = 0"), "renewal: 0 is out of range"),
        (changed("elites = 2", "elites = -1"), "elites: -1 is out of range"),
        (changed("elites = 2", "elites = 8"), "elites: 8 elites fill the population of 8"),
        (changed("renewal = 2", "mutation = 1.5"), "mutation: 1.5 is out of range; give 0 to 1"),
        (changed("renewal = 2", "crossover = -0.1"), "crossover: -0.1 is out of range"),
        (changed("renewal = 2", "integer_bits = 25"), "integer_bits: 25 is out of range"),
        (changed("renewal = 2", "integer_bits = 0\nfraction_bits = 0"), "integer_bits and fraction_bits are both 0"),
        (changed("renewal = 2", "integer_bits = 0"), "q[1]: 1 is outside 0 to 2^0"),
        (changed("renewal = 2", "stop = 1"), "stop: 1 is neither true nor false"),
        (changed("step = 0.5", "step = 0"), "network_operator.step: 0 s; give more than 0 s"),
        (changed("stop_time = 320", "stop_time = -1"), "stop_time: -1 s"),
        (changed('component = "guidance"\n', ""), "network_operator.component: missing"),
        (changed('"diveev_2013_basic"', '"none"'), "no such law or file"),
        (changed("[network_operator.objectives]", "[other]"), "other: unknown key"),
        (changed('speed = "final_speed"', 'speed = "sped"'), "objectives.speed: 'sped' is not a metric"),
        (changed('speed = "final_speed"', 'speed = "1 +"'), "objectives.speed"),
        (changed('speed = "final_speed"', '"a b" = "final_speed"'), "'a b' is not a plain name"),
        (TEXT.split("[network_operator.objectives]")[0], "network_operator.objectives: no objective"),
        (
            TEXT + '[compare]\nguidance = ["a", "b"]\n',
            "compare: not allowed here: a synthesis evaluates one law at a time",
        ),
        (TEXT + '[group]\nby = "x"\n', "group: not allowed here: a synthesis evaluates a law on all trials"),
        (TEXT + '[record]\ntraces = "all"\n', "record: not allowed here: a synthesis stores no simulations"),
        (changed('"sensor.altitude_noise" = 0.02', '"guidance.q[2]" = 1'), "guidance.q[2]: a parameter of the law"),
        (
            changed('[draw."plant.initial_altitude"]', '[draw."guidance.matrix[1,7]"]'),
            "guidance.matrix[1,7]: a parameter of the law, which the search sets",
        ),
        (changed("trials = 4", "trials = 0"), "trials: 0 trial(s)"),
        (changed("seed = 11", "seed = 1.5"), "seed: 1.5 is not a whole number"),
    ],
)
def test_mistakes_are_named(tmp_path, text, words):
    with pytest.raises(InputError) as caught:
        read(tmp_path, text)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_basic_solution_that_cannot_be_varied(tmp_path):
    document = find_law("diveev_2013_basic").read_text()
    row = " [ 0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  0,  1,  0]"
    (tmp_path / "mine.json").write_text(document.replace(row, row.replace("1", "0")))
    with pytest.raises(InputError, match=r"mine.json: matrix: no edge leads to node 15; add an edge to the node"):
        read(tmp_path, TEXT.replace("diveev_2013_basic", "mine.json"))


def test_a_batch_does_not_fly_a_synthesis(tmp_path):
    path = tmp_path / "search.toml"
    path.write_text(TEXT)
    with pytest.raises(
        InputError,
        match="network_operator: declares a search, which perilune batch cannot run; search with perilune",
    ):
        read_campaign(path)
