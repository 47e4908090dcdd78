"""Server of `perilune show`, on the loopback address of this machine only, until interrupted."""

from __future__ import annotations

import asyncio
import os
import secrets
import socket
from collections.abc import Callable, Sequence
from pathlib import Path

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from ...common.errors import InputError
from .app import Service, make_app
from .browser_page import show_page
from .opened_campaign import open_campaign

HOST = "127.0.0.1"
TOKEN_BYTES = 32
PATIENCE = 1  # s, for requests in progress at the end
CONNECTIONS = 64
SILENCE = 10  # s, after which a connection without a request is closed, since others wait for it


class CampaignServer:
    """Server of campaigns; ``address`` is the address of its page, including the token."""

    def __init__(self, folders: Sequence[Path], port: int = 0) -> None:
        """Open campaigns and listen on ``port`` (0: any free port).

        Raises InputError for other folders and a port in use.
        """
        self._is_stopped = False
        self.campaigns = [open_campaign(folder, lambda: self._is_stopped) for folder in folders]
        page = show_page(self.campaigns)
        self._socket = _listen(port)
        self.port = self._socket.getsockname()[1]
        self._token = secrets.token_urlsafe(TOKEN_BYTES)
        self._page = page

    @property
    def address(self) -> str:
        return f"http://{HOST}:{self.port}/?token={self._token}"

    def serve(self, announce: Callable[[str], None]) -> None:
        """Serve until Ctrl-C; ``announce`` is called with the address as soon as the server listens."""
        service = Service(self.campaigns, self._page)
        server = _Server(
            uvicorn.Config(
                make_app(service, f"{HOST}:{self.port}", self._token),
                log_config=None,
                log_level="error",  # without warnings about invalid requests
                access_log=False,
                lifespan="off",
                ws="none",
                http=_Protocol,
                loop="asyncio",
                server_header=False,
                proxy_headers=False,
                limit_concurrency=CONNECTIONS,
                timeout_graceful_shutdown=PATIENCE,
            ),
            lambda: announce(self.address),
            self._stop,
        )
        try:
            server.run(sockets=[self._socket])
        except KeyboardInterrupt:  # raised again by uvicorn after everything is closed
            pass
        finally:
            self._stop()
            service.stop()
            self._socket.close()

    def _stop(self) -> None:
        self._is_stopped = True


class _Protocol(H11Protocol):
    """HTTP protocol of uvicorn that closes a connection without a request after `SILENCE`."""

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        self.loop.call_later(SILENCE, self._end_silence)

    def _end_silence(self) -> None:
        if self.cycle is None:
            self.transport.close()


class _Server(uvicorn.Server):
    """Server of uvicorn that reports when it starts to listen and when it has to stop."""

    def __init__(self, config: uvicorn.Config, on_start: Callable[[], None], on_end: Callable[[], None]) -> None:
        super().__init__(config)
        self._on_start = on_start
        self._on_end = on_end

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._on_start()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._on_end()
        await super().shutdown(sockets)


def _listen(port: int) -> socket.socket:
    listening = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    if os.name == "posix":  # permits a port with unclosed connections; on Windows it would permit a port in use
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((HOST, port))
    except OSError as error:
        listening.close()
        raise InputError(
            "`port`", str(port), error.strerror or str(error), "give another port, or leave out `port`"
        ) from error
    return listening
