"""`perilune show` as a process: listening address, answers over a socket, end of the process.

Truth: the operating system's list of sockets, the exit status, and bytes on a socket.
"""

from __future__ import annotations

import asyncio
import re
import signal
import socket
from urllib.parse import urlsplit

import psutil
import pytest

import perilune
from perilune.analysis.cli import main
from perilune.analysis.show.server import CONNECTIONS
from perilune.common.errors import InputError
from tests.support.campaigns.showing import showing


def answer_of(port, text):
    """Return the first line of the answer to the bytes of a request."""
    with socket.create_connection(("127.0.0.1", port), timeout=30) as connection:
        connection.sendall(text.replace("\n", "\r\n").encode("latin-1"))
        content = b""
        while chunk := connection.recv(65536):
            content += chunk
        return content.decode()


def test_from_the_address_to_the_end(campaign_folder):
    with showing([campaign_folder, campaign_folder]) as (address, process):
        url = urlsplit(address)
        authority, port, query = url.netloc, url.port, url.query
        assert re.fullmatch(r"127\.0\.0\.1:\d+", authority)
        token = re.fullmatch(r"token=([\w-]{40,})", query)[1]
        listening = [each for each in psutil.Process(process.pid).net_connections() if each.status == "LISTEN"]
        assert [each.laddr for each in listening] == [("127.0.0.1", port)]
        head = f"Host: {authority}\nConnection: close\n"
        cookie = f"Cookie: perilune-{port}={token}\n"
        admitted = answer_of(port, f"GET /?{query} HTTP/1.1\n{head}\n")
        assert admitted.startswith("HTTP/1.1 303 ")
        page = answer_of(port, f"GET / HTTP/1.1\n{head}{cookie}\n")
        assert page.startswith("HTTP/1.1 200 ")
        assert "connect-src &#39;self&#39;" in page
        assert token not in page
        for number, status in ((0, 200), (1, 200), (2, 404)):
            counts = answer_of(port, f"GET /campaigns/{number}/counts HTTP/1.1\n{head}{cookie}\n")
            assert counts.startswith(f"HTTP/1.1 {status} ")
        for path in ("/..", "/../../etc/passwd", "../../etc/passwd", "/%2e%2e/summary.json", "//etc/passwd"):
            refused = answer_of(port, f"GET {path} HTTP/1.1\n{head}{cookie}\n")
            assert re.match(r"HTTP/1.1 40[04] ", refused), refused
        for request, status in (
            (f"GET / HTTP/1.1\n{head}\n", 403),
            (f"GET / HTTP/1.1\nHost: localhost:{port}\nConnection: close\n{cookie}\n", 421),
            (f"GET / HTTP/1.1\nHost: evil\nHost: {authority}\nConnection: close\n{cookie}\n", 400),
            (f"GET / HTTP/1.0\n{cookie}\n", 421),
            (f"GET / HTTP/1.1\n{head}{cookie}Origin: http://evil.example\n\n", 403),
            (f"POST / HTTP/1.1\n{head}{cookie}Content-Length: 0\n\n", 405),
        ):
            assert answer_of(port, request).startswith(f"HTTP/1.1 {status} "), request
        idle = socket.create_connection(("127.0.0.1", port))  # of a browser that keeps its connection
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=30)  # benchmarks/show.py measures it
        assert (process.returncode, out.splitlines()[-1], err) == (0, "stopped", "")
        idle.close()
    with showing([campaign_folder], "--port", str(port)) as (address, _):  # the port is free at once
        assert urlsplit(address).port == port


def test_a_port_in_use(campaign_folder, capsys):
    with socket.socket() as occupied:
        occupied.bind(("127.0.0.1", 0))
        occupied.listen()
        assert main(["show", str(campaign_folder), "--port", str(occupied.getsockname()[1])]) == 2
    assert re.fullmatch(r"perilune: --port: \d+: Address already in use; .+\n", capsys.readouterr().err)


def test_connections_without_a_request(campaign_folder, monkeypatch):
    """They are closed, so that others are answered."""
    before = "import perilune.analysis.show.server as server; server.SILENCE = 0.5; "
    with showing([campaign_folder], before=before) as (address, _):
        url = urlsplit(address)
        idle = [socket.create_connection(("127.0.0.1", url.port)) for _ in range(CONNECTIONS + 5)]
        for each in idle:
            each.settimeout(30)
            while each.recv(1024):
                pass
            each.close()
        request = f"GET /?{url.query} HTTP/1.1\nHost: {url.netloc}\nConnection: close\n\n"
        assert answer_of(url.port, request).startswith("HTTP/1.1 303 ")


def test_in_an_event_loop(campaign_folder):
    async def call():
        perilune.show(campaign_folder)

    with pytest.raises(InputError, match="an event loop is already running"):
        asyncio.run(call())


@pytest.mark.slow
def test_a_chosen_port(campaign_folder):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with showing([campaign_folder], "--port", str(port)) as (address, _):
        assert urlsplit(address).port == port
