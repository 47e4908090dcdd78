"""Refusals of the server: requests without a token, from other origins, that write, or for files.

Truth: the rules of docs/guides/show.md: status, and absence of content.
"""

from __future__ import annotations

import asyncio
import json

import pytest

from perilune.analysis.show.app import make_app
from tests.support.campaigns.show_client import AUTHORITY, COOKIE, PAGE, TOKEN, request

QUERY = "/campaigns/0/counts"
ADMISSION = f"/?token={TOKEN}"
EVERYWHERE = pytest.mark.parametrize("path", ["/", ADMISSION, QUERY])


@pytest.fixture
def send(client):
    """Return a sender of requests with no headers but those of the test."""

    def send(path, method="GET", **headers):
        return request(client.service, method, path, headers=headers)

    return send


def test_the_token_becomes_a_cookie_and_leaves_the_address(send):
    answer = send(ADMISSION)
    assert (answer.status_code, answer.headers["location"]) == (303, "/")
    cookie, *flags = [each.strip() for each in answer.headers["set-cookie"].split(";")]
    assert cookie == COOKIE
    assert {"httponly", "samesite=strict", "path=/"} == {each.lower() for each in flags}
    opened = send("/", cookie=cookie)
    assert opened.text == PAGE
    assert opened.headers["referrer-policy"] == "no-referrer"
    assert opened.headers["cache-control"] == "no-store"


@pytest.mark.parametrize("other", ['a={"x":1}', "[=1", "path", "path=/", "a=\\"])
def test_cookies_of_other_servers(send, other):
    """Browsers send cookies of 127.0.0.1 to all of its ports."""
    assert send("/", cookie=f"{other}; {COOKIE}").text == PAGE


@pytest.mark.parametrize("path", ["/", QUERY, "/campaigns/0/trials/3", "/nowhere"])
@pytest.mark.parametrize(
    "cookie",
    [
        None,
        "perilune-4711=",
        "perilune-4711=wrong",
        f"{COOKIE}x",
        f"perilune={TOKEN}",
        f"perilune-4712={TOKEN}",
        b"perilune-4711=\xe4",
        ';;=,\\"',
    ],
)
def test_no_and_wrong_cookie(send, path, cookie):
    answer = send(path, **({} if cookie is None else {"cookie": cookie}))
    assert answer.status_code == 403
    assert PAGE not in answer.text


@pytest.mark.parametrize(
    "query",
    ["token=", "token=wrong", f"token={TOKEN}&token=wrong", "token=%C3%A4", f"TOKEN={TOKEN}", f"token={TOKEN}x"],
)
def test_no_and_wrong_token(send, query):
    answer = send(f"/?{query}")
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers


@EVERYWHERE
@pytest.mark.parametrize(
    "host",
    [
        "evil.example",
        "127.0.0.1",
        "127.0.0.1:80",
        "localhost:4711",
        f"{AUTHORITY}.evil.example",
        f"evil.example@{AUTHORITY}",
        "[::1]:4711",
        "",
    ],
)
def test_another_host(send, path, host):
    answer = send(path, cookie=COOKIE, host=host)
    assert answer.status_code == 421
    assert "set-cookie" not in answer.headers


@EVERYWHERE
@pytest.mark.parametrize("origin", ["null", "http://evil.example", f"https://{AUTHORITY}", "http://127.0.0.1:81", ""])
def test_another_origin(send, path, origin):
    answer = send(path, cookie=COOKIE, origin=origin)
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers


def test_its_own_origin(send):
    assert send("/", cookie=COOKIE, origin=f"http://{AUTHORITY}").text == PAGE


@EVERYWHERE
@pytest.mark.parametrize("method", ["POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "PROPFIND"])
def test_nothing_is_written(send, method, path):
    answer = send(path, method, cookie=COOKIE)
    assert (answer.status_code, answer.headers["allow"]) == (405, "GET, HEAD")


def test_a_long_path(send):
    assert send(f"/campaigns/{'9' * 5000}/counts", cookie=COOKIE).status_code == 414


def test_heads_are_answered(send):
    assert send("/", "HEAD", cookie=COOKIE).status_code == 200


@pytest.mark.parametrize(
    "path",
    [
        "/../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "//etc/passwd",
        "/etc/passwd",
        "/summary.json",
        "/campaigns/0/../../summary.json",
        "/campaigns/0/%2e%2e/summary.json",
        "/campaigns/%2fetc%2fpasswd/counts",
        "/campaigns/file:///etc/passwd/counts",
        "/campaigns/-1/counts",
        "/campaigns/1/counts",
        "/campaigns/99999999999999999999/counts",
        "/campaigns/0/trials/99999999999999999999",
        "/campaigns/0/trials/6300",
        "/campaigns/0/trials/-1",
        "/campaigns/0/counts/",
        "/campaigns/0/counts%00",
    ],
)
def test_no_path_names_a_file(send, campaign_folder, path):
    answer = send(f"http://{AUTHORITY}{path}", cookie=COOKIE)
    assert answer.status_code == 404
    assert "root:" not in answer.text
    assert str(campaign_folder) not in answer.text


@pytest.mark.parametrize(
    "query",
    [
        "",
        "[",
        "[" * 7000,
        "x" * 9000,
        json.dumps({"histograms": [42]}),
        json.dumps({"histograms": [-1]}),
        json.dumps({"histograms": ["metric.m0"]}),
        json.dumps({"histograms": [0] * 100}),
        json.dumps({"grids": [[0, 1, 2]]}),
        json.dumps({"ranges": [{"column": 0, "first": 0, "last": 4096}]}),
        json.dumps({"ranges": [{"column": "/etc/passwd", "first": 0, "last": 1}]}),
        json.dumps({"variants": [3]}),
        json.dumps({"outcome": "both"}),
        json.dumps({"file": "/etc/passwd"}),
    ],
)
def test_other_queries_are_refused_in_one_line(client, query):
    answer = client.get(QUERY, params={"query": query})
    assert answer.status_code == 422
    assert answer.text.startswith("query: ")
    assert "\n" not in answer.text


def test_web_sockets_are_not_accepted(client):
    sent = []

    async def send(message):
        sent.append(message)

    async def receive():
        return {"type": "websocket.connect"}

    scope = {"type": "websocket", "path": "/", "headers": [(b"host", AUTHORITY.encode()), (b"cookie", COOKIE.encode())]}
    asyncio.run(make_app(client.service, AUTHORITY, TOKEN)(scope, receive, send))
    assert not sent
