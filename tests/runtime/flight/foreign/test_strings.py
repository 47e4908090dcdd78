"""Strings over connections: they are transferred like Reals, whatever their FMU does with its memory afterwards.

Truth: results by hand for two Python FMUs: one counts its steps, and one repeats its input.
"""

import re

import numpy as np
import pytest
from pythonfmu import FmuBuilder

from perilune.common.errors import InputError
from tests.support.builders import component, connection, dedented, document, fly, pack, system

SPEAKER = """
    from pythonfmu import Fmi2Causality, Fmi2Slave, Integer, String


    class Speaker(Fmi2Slave):
        def __init__(self, **keywords):
            super().__init__(**keywords)
            self.steps, self.longest, self.word = 0, 10, "start"
            self.register_variable(Integer("longest", causality=Fmi2Causality.parameter))
            self.register_variable(String("word", causality=Fmi2Causality.output))

        def do_step(self, current_time, step_size):
            self.steps += 1
            self.word = "é" * min(self.steps, self.longest)
            return True
"""
LISTENER = """
    from pythonfmu import Fmi2Causality, Fmi2Slave, Integer, String


    class Listener(Fmi2Slave):
        def __init__(self, **keywords):
            super().__init__(**keywords)
            self.heard, self.length, self.echo = "nothing", 0, ""
            self.register_variable(String("heard", causality=Fmi2Causality.input))
            self.register_variable(Integer("length", causality=Fmi2Causality.output))
            self.register_variable(String("echo", causality=Fmi2Causality.output))

        def exit_initialization_mode(self):
            self.length, self.echo = len(self.heard), self.heard

        def do_step(self, current_time, step_size):
            self.length, self.echo = len(self.heard), self.heard
            return True
"""
TOLD = "input heard String; output length Integer; output echo String"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("strings")
    for name, text in (("Speaker", SPEAKER), ("Listener", LISTENER)):
        (folder / f"{name}.py").write_text(dedented(text))
        FmuBuilder.build_FMU(folder / f"{name}.py", folder)
    return folder


def chain(folder, path, **options):
    root = system(
        component("speaker", "Speaker", "output word String"),
        component("first", "Listener", TOLD),
        component("second", "Listener", TOLD),
        connections=connection("speaker.word", "first.heard") + connection("first.echo", "second.heard"),
    )
    return fly(pack(path, folder, document(root)), feedthrough=("first", "second"), **options)


def test_strings_arrive(folder, tmp_path):
    result = chain(folder, tmp_path / "s.ssp")
    assert result["first.length"].tolist() == [5, 1, 2, 3, 4]
    assert result["second.length"].tolist() == [0, 1, 2, 3, 4]  # the first one's echo is there after initialisation
    assert not {"speaker.word", "first.heard"} & set(result.signals)


def test_strings_arrive_a_step_late_under_jacobi(folder, tmp_path):
    result = chain(folder, tmp_path / "s.ssp", algorithm="jacobi")
    assert result["first.length"].tolist() == [5, 5, 1, 2, 3]
    assert result["second.length"].tolist() == [0, 5, 5, 1, 2]


def test_a_string_through_systems_and_one_given_to_the_system(folder, tmp_path):
    inner = system(
        component("listener", "Listener", TOLD),
        name="inner",
        declared="input word String; output said String",
        connections=connection("word", "listener.heard") + connection("listener.echo", "said"),
    )
    root = system(
        inner,
        component("last", "Listener", TOLD),
        declared="input word String",
        connections=connection("word", "inner.word") + connection("inner.said", "last.heard"),
    )
    path = pack(tmp_path / "s.ssp", folder, document(root))
    result = fly(path, set={"word": "seventeen letters"})
    assert set(result["last.length"][1:]) == {17}
    with pytest.raises(InputError, match=r"word \(line \d+\): input is neither connected nor given a value"):
        fly(path)


def test_a_string_that_is_too_long_ends_the_flight(folder, tmp_path):
    result = chain(folder, tmp_path / "s.ssp", set={"speaker.longest": 10**6}, step=1e-4, stop_time=0.3)
    assert result.status == "failed"
    assert re.search(r"speaker\.word gave a string of 4096 bytes or more at t = 0\.2048 s", result.message)
    np.testing.assert_array_equal(result["first.length"][1:], np.arange(1, result.time.size))


def test_strings_and_numbers_do_not_fit(folder, tmp_path):
    wires = connection("speaker.word", "other.longest")
    root = system(
        component("speaker", "Speaker", "output word String"),
        component("other", "Speaker", "parameter longest Integer"),
        connections=wires,
    )
    with pytest.raises(InputError, match=r"connects output speaker\.word with parameter other\.longest"):
        fly(pack(tmp_path / "s.ssp", folder, document(root)))
