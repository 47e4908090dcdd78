"""perilune.analysis.documents.common.signals: groups, vectors and paths among signals. Truth: signals listed here."""

from perilune.analysis.documents.common.signals import distinct, position_groups, signal_groups
from tests.support.pages.samples import run_result


def test_vectors_come_together_and_components_are_known():
    groups = {group.label: group for group in signal_groups(run_result())}
    assert list(groups) == [
        "ship.position", "ship.tilt", "ship.mass", "ship.status",
        "crew.cook.position", "crew.cook.spike", "crew.cook.awake", "finished",
    ]  # fmt: skip
    assert groups["crew.cook.position"].component == "crew.cook"
    assert groups["crew.cook.position"].indices == ("1", "2", "3")
    assert groups["finished"].component == ""
    assert groups["ship.tilt"].names == ("ship.tilt",)


def test_every_signal_is_in_one_group():
    result = run_result()
    assert sorted(name for group in signal_groups(result) for name in group.names) == sorted(result.signals)


def test_elements_of_different_units_are_not_one_vector():
    result = run_result()
    result.units["ship.position[3]"] = "km"
    assert [group.indices for group in signal_groups(result) if group.label == "ship.position"] == [("1", "2"), ("3",)]


def test_repeated_signals_are_found():
    result = run_result()
    copies = {group.label: first.label for group, first in distinct(signal_groups(result), result).items()}
    assert copies["crew.cook.position"] == "ship.position"
    assert copies["ship.tilt"] == "ship.tilt"


def test_paths_are_found_by_name_and_unit():
    result = run_result()
    assert [group.label for group in position_groups(result)] == ["ship.position"]
    result.signals["crew.cook.position[1]"] = result["crew.cook.position[1]"] + 1.0
    assert [group.label for group in position_groups(result)] == ["ship.position", "crew.cook.position"]
    result.units |= {f"{part}.position[{i}]": "km" for part in ("ship", "crew.cook") for i in (1, 2, 3)}
    assert position_groups(result) == []
