"""perilune.analysis.campaigns.definition.file: permitted content of a campaign file; all else is refused by name."""

from dataclasses import replace

import pytest

from perilune.analysis.campaigns.definition.campaign import Scatter
from perilune.analysis.campaigns.definition.file import read_campaign
from perilune.common.errors import InputError

FULL = """
system = "lander"
description = '''two
   lines'''
trials = 4
seed = 9
parameters = ["a.ssv", "b.ssv"]
[set]
plant.gravity = 1.6
"plant.position[1]" = 2
plant.latch = true
[compare]
guidance = ["g1", "g2"]
navigation = ["n1", "n2"]
[draw.x]
distribution = "uniform"
low = "-pi/4"
high = 1
[draw.plant.mass]
distribution = "normal"
mean = 900
sigma = 10.0
[draw.errors]
distribution = "correlated_normal"
names = ["u", "nav.bias[1]"]
mean = [0, 1]
covariance = [[1, 0.5], [0.5, 2]]
[derive]
y = "2 * x"
plant.thrust = "y * plant.mass"
[metric.miss]
expression = "abs(plant.position[1])"
reduction = "final"
unit = "m"
description = "how far"
[metric.settled]
expression = "plant.velocity[1]"
reduction = "last_outside"
band = [-inf, 1]
window = [10, inf]
[metric.at_gate]
expression = "plant.mass"
reduction = "first"
condition = "plant.position[1] < 5"
delay = "2 * 0.5"
[group]
by = "y"
[record]
final = ["plant.mass"]
every = 10
signals = ["plant.position[1]"]
traces = "failures"
[success]
expression = "miss < 1"
"""


def test_everything_is_read(parse):
    read = parse(FULL)
    assert (read.system, read.description, read.trials, read.seed) == ("lander", "two lines", 4, 9)
    assert read.parameters == ("a.ssv", "b.ssv")
    assert read.settings == {"plant.gravity": 1.6, "plant.position[1]": 2, "plant.latch": True}
    assert read.input_names() == ["x", "plant.mass", "u", "nav.bias[1]", "y", "plant.thrust"]
    assert read.draws[0].distribution.arguments == {"low": pytest.approx(-0.7853981633974483), "high": 1.0}
    miss, settled, gate = read.metrics
    assert (miss.name, miss.reduction, miss.unit, miss.band, miss.window) == ("miss", "final", "m", None, None)
    assert (settled.band, settled.window) == ((-float("inf"), 1.0), (10.0, float("inf")))
    assert (gate.condition.text, gate.delay, gate.names) == (
        "plant.position[1] < 5", 1.0, {"plant.mass", "plant.position[1]"},
    )  # fmt: skip
    assert (miss.condition, miss.delay) == (None, 0.0)
    assert read.group == "y"
    assert (read.record.every, read.record.traces) == (10, "failures")
    assert read.success.names == {"miss"}


def test_scatters_are_of_metrics(parse):
    first = '[scatter.where]\nx = "miss"\ny = "miss"\ncircle = "2 * 5"\ntitle = "Where"\n'
    second = '[scatter.plain]\nx = "settled"\ny = "at_gate"\n'
    where, plain = parse(FULL + first + second).scatters
    assert where == Scatter("where", "miss", "miss", 10.0, "Where")
    assert plain == Scatter("plain", "settled", "at_gate")


def test_variants_are_all_combinations(parse, campaign):
    variants = parse(FULL).variants()
    assert [variant.name for variant in variants] == ["g1__n1", "g1__n2", "g2__n1", "g2__n2"]
    assert variants[1].use == {"guidance": "g1", "navigation": "n2"}
    assert [(variant.name, variant.use) for variant in campaign("").variants()] == [("default", {})]


def test_replaced_trials_and_seed_are_checked_too(campaign):
    with pytest.raises(InputError, match=r"^test\.toml: trials: 0 trial\(s\); give 1 or more$"):
        replace(campaign(""), trials=0)
    with pytest.raises(InputError, match="seed: -1 is negative"):
        replace(campaign(""), seed=-1)


DRAW = '[draw.x]\ndistribution = "{}"\n'
UNIFORM = DRAW.format("uniform") + "low = 0\nhigh = 1\n"
UNITS = {"m": "1", "n": "kg"}
PAIR = "".join(
    f'[metric.{name}]\nexpression = "a.b"\nreduction = "min"\nunit = "{unit}"\n' for name, unit in UNITS.items()
)
METRIC = '[metric.m]\nexpression = "a.b"\nreduction = "{}"\n'


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[sets]\n", "sets: unknown key; allowed here: system, description, trials"),
        ("[draw]\nx = 1\n", "draw.x: not a table"),
        ("[draw.x]\nlow = 1\n", "draw.x.distribution: missing"),
        (DRAW.format("gauss"), "draw.x.distribution: 'gauss' is not known; use one of uniform, normal"),
        (DRAW.format("uniform") + "low = 1\n", "draw.x.high: missing"),
        (DRAW.format("uniform") + "low = 1\nhigh = 1\n", "draw.x.high: 1.0 is not above low"),
        (DRAW.format("uniform") + "low = 0\nhigh = inf\n", "draw.x.high: inf is not finite"),
        (DRAW.format("uniform") + "low = 0\nhigh = true\n", "draw.x.high: True is not a number"),
        (DRAW.format("uniform") + 'low = 0\nhigh = "y"\n', "draw.x.high: 'y' is not constant"),
        (UNIFORM + "sigma = 1\n", "draw.x.sigma: unknown key; allowed here: distribution, low, high"),
        (DRAW.format("normal") + "mean = 0\nsigma = 0\n", "draw.x.sigma: 0.0 is not positive"),
        (DRAW.format("choice") + "values = []\n", "draw.x.values: [] is not a list of values"),
        (DRAW.format("choice") + "values = [1, 2]\nweights = [1]\n", "draw.x.weights: 1 weight(s) for 2"),
        (DRAW.format("choice") + "values = [1, 2]\nweights = [1, -1]\n", "draw.x.weights: a weight is negative"),
        (DRAW.format("grid") + "low = 0\nhigh = 1\ncount = 1\n", "draw.x.count: 1 point(s)"),
        (DRAW.format("grid") + "values = [1]\ncount = 3\n", "draw.x.count: unknown key"),
        (DRAW.format("correlated_normal") + "mean = [1]\n", "draw.x.names: missing"),
        (
            DRAW.format("correlated_normal") + 'names = ["a", "a"]\nmean = [0, 0]\ncovariance = [[1]]\n',
            "draw.x.names: 'a' occurs twice",
        ),
        (
            DRAW.format("correlated_normal") + 'names = ["a", "b"]\nmean = [0, 0]\ncovariance = [[1, 0]]\n',
            "draw.x.covariance: not a 2 by 2 matrix",
        ),
        (
            DRAW.format("correlated_normal") + 'names = ["a", "b"]\nmean = [0, 0]\ncovariance = [[1, 1], [0, 1]]\n',
            "draw.x.covariance: not symmetric",
        ),
        (
            DRAW.format("correlated_normal") + 'names = ["a", "b"]\nmean = [0, 0]\ncovariance = [[1, 2], [2, 1]]\n',
            "draw.x.covariance: not a covariance",
        ),
        ("[draw.pi]\n" + UNIFORM.split("\n", 1)[1], "draw.pi: 'pi' is a reserved name"),
        ("[draw.time]\n" + UNIFORM.split("\n", 1)[1], "draw.time: 'time' is a reserved name"),
        ('[draw."a b"]\n' + UNIFORM.split("\n", 1)[1], "draw.a b: 'a b' is not a name"),
        (UNIFORM + '[derive]\nx = "1"\n', "derive.x: 'x' is declared twice"),
        (UNIFORM + '[derive]\ny = "z"\n', "derive.y: 'z' is not a draw or an earlier derived value; use one of x"),
        ('[derive]\ny = "z"\nz = "1"\n', "derive.y: 'z' is not a draw or an earlier"),
        ("[derive]\ny = 1\n", "derive.y: 1 is not a text"),
        ("[set]\ngravity = 1\n", "set.gravity: names no component"),
        ('[set]\nplant.x = ["a"]\n', "set.plant.x: ['a'] is not a valid value"),
        ('[set]\nplant.x = 1\n"plant.x" = 2\n', "set.plant.x: occurs twice"),
        ('[set]\nplant.x = 1\n[derive]\nplant.x = "1"\n', "set.plant.x: is also drawn or derived"),
        ('[compare]\ng = "a"\n', "compare.g: 'a' is not a list"),
        ('[compare]\ng = ["a", "a"]\n', "compare.g: 'a' occurs twice"),
        (METRIC.format("median"), "metric.m.reduction: 'median' is not known; use one of final, min"),
        (METRIC.format("last_outside"), "metric.m.band: missing"),
        (METRIC.format("mean") + "band = [0, 1]\n", "metric.m.band: not used by the reduction 'mean'"),
        (METRIC.format("settled") + "band = [0, 1]\n", "metric.m.band: not used by the reduction 'settled'"),
        (METRIC.format("first"), "metric.m.condition: missing"),
        (METRIC.format("first") + "condition = 1\n", "metric.m.condition: 1 is not a text"),
        (METRIC.format("first") + 'condition = "1 +"\n', "metric.m.condition: invalid syntax"),
        (METRIC.format("first") + 'condition = "a.b"\ndelay = -1\n', "metric.m.delay: -1 is negative"),
        (METRIC.format("first") + 'condition = "a.b"\ndelay = inf\n', "metric.m.delay: inf is not finite"),
        (METRIC.format("settled") + 'condition = "a.b"\n', "metric.m.condition: not used by the reduction 'settled'"),
        (
            METRIC.format("max") + "delay = 1\n",
            "metric.m.delay: not used by the reduction 'max'; remove delay, or use first",
        ),
        (METRIC.format("mean") + "window = [1, 0]\n", "metric.m.window: [1, 0] is not an interval"),
        (METRIC.format("mean") + "window = [nan, 0]\n", "metric.m.window[1]: nan is not a number"),
        ('[metric."a.b"]\n', "metric.a.b: 'a.b' is not a plain name"),
        (UNIFORM + "[metric.x]\n", "metric.x: 'x' is declared twice"),
        ('[record]\ntraces = "some"\n', "record.traces: 'some' is not known; use one of none, failures, all"),
        ("[record]\nevery = 2\n", "record.signals: missing"),
        ('[record]\nsignals = ["a"]\n', "record.every: missing"),
        ('[record]\nevery = 0\nsignals = ["a"]\n', "record.every: 0 row(s)"),
        ("[record]\nfinals = 1\n", "record.finals: unknown key"),
        (PAIR + '[scatter."a b"]\n', "scatter.a b: 'a b' is not a plain name"),
        (PAIR + '[scatter.s]\nx = "m"\n', "scatter.s.y: missing"),
        (PAIR + '[scatter.s]\nx = "m"\ny = "o"\n', "scatter.s.y: 'o' is not a metric; use one of m, n"),
        (
            PAIR + '[scatter.s]\nx = "m"\ny = "n"\nz = 1\n',
            "scatter.s.z: unknown key; allowed here: x, y",
        ),
        (PAIR + '[scatter.s]\nx = "m"\ny = "m"\ncircle = 0\n', "scatter.s.circle: 0 is not a radius"),
        (PAIR + '[scatter.s]\nx = "m"\ny = "n"\ncircle = 1\n', "scatter.s.circle: m is in 1, but n is in kg"),
    ],
)
def test_what_is_wrong_is_named_with_its_place(campaign, text, says):
    with pytest.raises(InputError) as caught:
        campaign(text)
    assert str(caught.value).startswith(f"test.toml: {says}")


def test_success_is_over_metrics_only(parse):
    with pytest.raises(
        InputError, match=r"success\.expression: 'plant\.mass' is not a metric; use one of at_gate, miss, settled"
    ):
        parse(FULL.replace("miss < 1", "plant.mass < 1"))


@pytest.mark.parametrize("key", ["system", "trials", "seed"])
def test_required_keys(parse, key):
    lines = [line for line in FULL.splitlines() if not line.startswith(f"{key} =")]
    with pytest.raises(InputError, match=f"^test.toml: {key}: missing"):
        parse("\n".join(lines))


def test_success_is_required(parse):
    with pytest.raises(InputError, match=r"^test\.toml: success\.expression: missing"):
        parse(FULL.replace('[success]\nexpression = "miss < 1"', ""))


@pytest.mark.parametrize(
    ("content", "says"), [(b"a = \n", "not TOML"), (b"\xff", "byte 0: not UTF-8"), (None, "not found")]
)
def test_unreadable_files(tmp_path, content, says):
    path = tmp_path / "c.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=says) as caught:
        read_campaign(path)
    assert str(caught.value).startswith(str(path))
