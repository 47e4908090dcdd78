"""`perilune docs`: the first page of the site, by path or in a browser.

Truth: the path of a site written by the test, and the address that the browser is asked to open.
"""

from __future__ import annotations

import json
import webbrowser

import pytest

from perilune.analysis.cli import main


@pytest.fixture
def page(tmp_path, monkeypatch):
    path = tmp_path / "site" / "index.html"
    monkeypatch.setattr("perilune.analysis.verbs.docs.FIRST_PAGE", path)
    return path


@pytest.fixture
def opened(monkeypatch):
    """Record addresses that the browser was asked to open; none fails."""
    addresses = []
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


def test_a_site_that_is_not_built_is_refused(page, opened, capsys):
    assert main(["docs"]) == 2
    error = capsys.readouterr().err
    assert str(page) in error
    assert "make docs" in error
    assert error.count("\n") == 1
    assert opened == []


def test_print_gives_the_path_alone(page, opened, capsys):
    page.parent.mkdir()
    page.write_text("<title>Perilune</title>")
    assert main(["docs", "--print"]) == 0
    assert capsys.readouterr().out == f"{page}\n"
    assert main(["docs", "--print", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out) == {"page": str(page), "opened": False}
    assert opened == []


def test_a_browser_opens_the_first_page(page, opened, monkeypatch, capsys, refusal):
    page.parent.mkdir()
    page.write_text("<title>Perilune</title>")
    assert main(["docs"]) == 0
    assert opened == [page.as_uri()]
    monkeypatch.setattr(webbrowser, "open", lambda _: False)
    capsys.readouterr()
    assert "no browser could open the page" in refusal(["docs"])
