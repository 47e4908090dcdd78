"""Every verb's help says what its exit statuses mean.

Truth: the list of verbs; the statuses themselves are in the tests of the verbs.
"""

import pytest

from perilune.analysis.cli import FAILURES, VERBS, main


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_a_verb(verb, capsys):
    with pytest.raises(SystemExit) as stop:
        main([verb, "--help"])
    assert stop.value.code == 0
    words = " ".join(capsys.readouterr().out.split())
    one = f"{FAILURES[verb]}, or interrupted" if verb in FAILURES else "interrupted"
    assert words.endswith(f"Exit status: 0: done. 1: {one}. 2: wrong input, or a result could not be written.")


def test_no_verb_is_misnamed():
    assert set(FAILURES) <= set(VERBS)
