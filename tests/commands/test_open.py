"""--open: the page of --report in the user's browser, here replaced by a program of the test.

Truth: the address with which the program was called.
"""

import webbrowser

import pytest

from perilune.analysis.cli import main


@pytest.fixture
def browser_of(tmp_path, monkeypatch):
    """Make a shell script the only browser."""

    def browser_of(script):
        program = tmp_path / "browser"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)
        monkeypatch.setattr(webbrowser, "_tryorder", None)
        monkeypatch.setattr(webbrowser, "_browsers", {})
        monkeypatch.setenv("BROWSER", f"{program} %s")
        monkeypatch.setenv("PATH", "/bin")
        monkeypatch.delenv("DISPLAY", raising=False)

    return browser_of


def test_the_page_is_opened(browser_of, tmp_path, monkeypatch, fmus):
    browser_of(f"echo $1 > {tmp_path}/address")
    monkeypatch.chdir(tmp_path)
    assert main(["describe", "lunar_landing", "--report", "page.html", "--open"]) == 0
    assert (tmp_path / "address").read_text() == f"{(tmp_path / 'page.html').as_uri()}\n"


def test_a_browser_that_fails(browser_of, tmp_path, fmus, refusal):
    browser_of("exit 1")
    page = tmp_path / "page.html"
    assert f"--open: {page}: no browser could open the page; open the file in another way" in refusal(
        ["describe", "lunar_landing", "--report", str(page), "--open"]
    )
    assert page.is_file()


def test_without_a_browser_nothing_is_simulated(monkeypatch, tmp_path, refusal):
    monkeypatch.setattr(webbrowser, "_tryorder", [])
    page = tmp_path / "page.html"
    assert "--open: no browser is installed here" in refusal(["run", "lunar_landing", "--report", str(page), "--open"])
    assert not page.exists()


def test_without_a_page(refusal):
    assert "--open: has no effect unless --report is given" in refusal(["run", "lunar_landing", "--open"])
