"""perilune.analysis.design.trajectories.declared_bound and stored_bound: bound of a system, stored with its hash.

Truth: the parameter sets of the system; geometry in closed form; SHA-256 by hashlib.
"""

import hashlib
import json
import math
from dataclasses import replace

import pytest

from perilune.analysis.design.trajectories.declared_bound import landing_of, pieces_of, read_inputs
from perilune.analysis.design.trajectories.point_mass import landing_problem
from perilune.analysis.design.trajectories.stored_bound import (
    PLACE,
    MissingBound,
    StoredBound,
    digest,
    find_bound,
    read_bound,
    write_bound,
)
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.runtime.system.prepared import prepare_system
from perilune.common.errors import InputError
from tests.support.declared_bounds import PIECES, declared_system

pytestmark = pytest.mark.usefixtures("fmus")
RADIUS = 1737400.0
INPUTS = {
    "position": (266731.018, 0.0, -2233.338),
    "velocity": (-1676.17262, 0.0, 207.765129),
    "mass": 940.0,
    "dry_mass": 440.0,
    "specific_impulse": 319.0,
    "maximum_thrust": 5099.0,
    "moon_radius": RADIUS,
    "gravitational_parameter": 4.9028e12,
    "target_altitude": 4.0,
}
BURNS = ((0.0, 60.5), (110.0, 291.25))
BOUND = StoredBound(400.5, 291.25, 240, BURNS, {"braking": 399.5}, digest(INPUTS), INPUTS)


def prepared(place, **options):
    return prepare_system(place, SystemOptions(**options))


def test_inputs_are_the_systems_values(tmp_path):
    place = declared_system(tmp_path)
    assert read_inputs(prepared(place)) == INPUTS
    assert read_inputs(prepared(place, set={"plant.specific_impulse": 330})) == INPUTS | {"specific_impulse": 330.0}
    assert read_inputs(prepared("lunar_landing")) is None


def test_pieces(tmp_path):
    place = declared_system(tmp_path, PIECES)
    actual = read_inputs(prepared(place))
    assert {name: value for name, value in actual.items() if "." in name} == {
        "braking.altitude": 2400.0,
        "transfer.mass": 526.37,
        "transfer.minimum_thrust": 510.0,
        "transfer.start_altitude": 2400.0,
        "transfer.end_altitude": 100.0,
        "transfer.aside": (-1676.17262, 0.0),
    }
    pieces = pieces_of(actual, "here")
    vehicle, landing = landing_of(actual, "here")
    assert pieces["braking"] == (landing_problem(vehicle, replace(landing, target_altitude=2400.0)), 940.0)
    problem, mass = pieces["transfer"]
    assert mass == 526.37
    assert problem.end_position == (1676.17262, -2300.0)
    assert (problem.least, problem.most) == pytest.approx((510.0 / 526.37, 5099.0 / 526.37))
    assert problem.gravity.value == pytest.approx(1.6219, abs=1e-4)


@pytest.mark.parametrize(
    ("pieces", "words"),
    [
        ('<Stop name="a" altitude="1"/><Stop name="a" altitude="2"/>', "name 'a' is used twice"),
        ('<Stop name="a.b" altitude="1"/>', "name 'a.b' is not an identifier"),
        ('<Stop name="a"/>', "no altitude"),
        ('<Go name="a"/>', "unknown element"),
        (PIECES.replace("start_altitude", "altitude"), "no start_altitude"),
        (PIECES.replace("2400", "50"), "transfer: from 50 m to 100 m with 526.37 kg is not a descent"),
    ],
)
def test_wrong_pieces(tmp_path, pieces, words):
    place = declared_system(tmp_path, pieces)
    with pytest.raises(InputError, match=words):
        pieces_of(read_inputs(prepared(place)), "here")


def test_braking_starts_from_its_own_set(tmp_path):
    place = declared_system(tmp_path, start="lighter.ssv")
    assert read_inputs(prepared(place)) == INPUTS | {"mass": 930.0}


def test_a_landing_in_its_plane():
    vehicle, landing = landing_of(INPUTS, "here")
    x, _, z = INPUTS["position"]
    assert landing.range == pytest.approx(RADIUS * math.atan2(x, z + RADIUS))
    assert landing.altitude == pytest.approx(math.hypot(x, z + RADIUS) - RADIUS)
    assert (vehicle.mass, vehicle.minimum_thrust, landing.target_altitude) == (940.0, 0.0, 4.0)
    problem = landing_problem(vehicle, landing)
    assert problem.start_position == pytest.approx((x, z))
    assert problem.start_velocity == pytest.approx((-1676.17262, 207.765129))


@pytest.mark.parametrize("angle", [0.3, 2.0, -2.8])
def test_it_does_not_matter_where_the_flight_comes_from(angle):
    c, s = math.cos(angle), math.sin(angle)

    def turned(vector):
        return (c * vector[0], s * vector[0], vector[2])

    other = INPUTS | {"position": turned(INPUTS["position"]), "velocity": turned(INPUTS["velocity"])}
    one, two = landing_of(INPUTS, "here")[1], landing_of(other, "here")[1]
    for name in ("range", "altitude", "speed", "climb"):
        assert getattr(two, name) == pytest.approx(getattr(one, name), abs=1e-9)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"velocity": (-1676.0, 0.1, 207.0)}, "the velocity at the start of braking does not point towards the site"),
        ({"velocity": (1676.0, 0.0, -207.0)}, "the velocity at the start of braking does not point towards the site"),
        ({"position": (0.0, 0.0, 15e3)}, "braking starts vertically above the site"),
    ],
)
def test_no_plane_to_land_in(change, words):
    with pytest.raises(InputError, match=words):
        landing_of(INPUTS | change, "here")


def test_hash_is_of_every_input():
    plain = {name: list(value) if isinstance(value, tuple) else value for name, value in INPUTS.items()}
    assert digest(INPUTS) == hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()
    assert digest(dict(reversed(INPUTS.items()))) == digest(INPUTS)
    for name, value in INPUTS.items():
        other = (value[0], 1e-13, value[2]) if isinstance(value, tuple) else math.nextafter(value, math.inf)
        assert digest(INPUTS | {name: other}) != digest(INPUTS)


def test_stored_and_found(tmp_path):
    place = declared_system(tmp_path)
    missing = find_bound(prepared(place))
    assert missing == MissingBound(f"no {PLACE} in the system; store the bound with perilune design bound landing")
    assert write_bound(BOUND, place) == place / PLACE
    assert find_bound(prepared(place)) == BOUND
    other = find_bound(prepared(place, set={"plant.specific_impulse": 330, "plant.initial_mass": 900}))
    assert isinstance(other, MissingBound)
    assert other.reason.startswith(
        f"{PLACE} was computed for different values of mass, specific_impulse; store the bound with perilune"
    )
    write_bound(
        replace(BOUND, inputs=INPUTS | {"more.altitude": 1.0}, sha256=digest(INPUTS | {"more.altitude": 1.0})), place
    )
    assert find_bound(prepared(place)).reason.startswith(
        f"{PLACE} was computed for different values of more.altitude; store the bound with perilune design bound"
    )


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"{", "not JSON"),
        (b"[]", "its keys are not propellant, duration"),
        ({"propellant": "much"}, "not a bound"),
        ({"propellant": -1.0}, "-1.0 is not a positive number"),
        ({"burns": [[0.0]]}, "not a bound"),
        ({"pieces": {"braking": 0.0}}, "0.0 is not a positive number"),
        ({"inputs": {"mass": 1.0}}, "sha256: does not match the inputs"),
        ({"more": 1}, "its keys are not"),
    ],
)
def test_no_bound(tmp_path, content, words):
    document = json.loads(write_bound(BOUND, tmp_path).read_bytes())
    data = content if isinstance(content, bytes) else json.dumps(document | content).encode()
    with pytest.raises(InputError, match=words) as error:
        read_bound(data, "bound.json")
    assert "\n" not in str(error.value)
    assert read_bound(json.dumps(document).encode(), "bound.json") == BOUND
    assert replace(BOUND, intervals=1) != BOUND


@pytest.mark.parametrize(
    ("roles", "words"),
    [
        ({"mass": None}, r"Bound \(line \d+\): no mass; write mass="),
        ({"mass": "plant.weight"}, "plant.weight: no such parameter; name a parameter as COMPONENT.VARIABLE"),
        ({"mass": "nobody.mass"}, "nobody.mass: no such parameter"),
        ({"speed": "3"}, "unknown attribute speed"),
        ({"start": "none.ssv"}, "neither the system nor the working folder has a file none.ssv"),
    ],
)
def test_wrong_declarations(tmp_path, roles, words):
    with pytest.raises(InputError, match=words):
        read_inputs(prepared(declared_system(tmp_path, **roles)))
