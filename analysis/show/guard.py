"""Access rules: read-only, and only for the browser that has the server's token, from the server's own page.

The printed address contains the token. The first request with it receives a cookie and is redirected to an address
without the token, which therefore appears neither in the history nor in referrers.
"""

from __future__ import annotations

import hmac
from urllib.parse import parse_qs

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import cookie_parser
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

METHODS = ("GET", "HEAD")
LONGEST_PATH = 100  # characters; longer numbers are not valid
HEADERS = {  # headers of every answer
    "cache-control": "no-store",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
}


class Guard:
    """Application protected by these rules; ``authority`` is its host and port, and ``token`` is its secret."""

    def __init__(self, app: ASGIApp, authority: str, token: str) -> None:
        self.app = app
        self.authority = authority
        self.token = token
        self.cookie = f"perilune-{authority.rpartition(':')[2]}"  # browsers send cookies to all ports of a host

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return  # no web socket is accepted

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, text in HEADERS.items():
                    headers[name] = text
            await send(message)

        await (self._refusal(scope) or self.app)(scope, receive, send_guarded)

    def _refusal(self, scope: Scope) -> Response | None:
        """Return the response that refuses a request; None if the application may answer it."""
        headers = Headers(scope=scope)
        if headers.getlist("host") != [self.authority]:
            return PlainTextResponse(f"use http://{self.authority}/: other names of this machine are refused", 421)
        if headers.getlist("origin") not in ([], [f"http://{self.authority}"]):
            return PlainTextResponse("requests from pages of other sites are refused", 403)
        if len(scope["path"]) > LONGEST_PATH:
            return PlainTextResponse("the path is too long", 414)
        if scope["method"] not in METHODS:
            return PlainTextResponse("read-only", 405, {"allow": ", ".join(METHODS)})
        tokens = parse_qs(scope["query_string"].decode("latin-1")).get("token")
        if scope["path"] == "/" and tokens is not None:
            return self._admit(tokens)
        if not any(self._is_token(text) for text in self._cookies(headers)):
            return PlainTextResponse("open the address that perilune show has printed", 403)
        return None

    def _admit(self, tokens: list[str]) -> Response:
        if len(tokens) != 1 or not self._is_token(tokens[0]):
            return PlainTextResponse("wrong token", 403)
        response = RedirectResponse("/", 303)
        response.set_cookie(self.cookie, self.token, path="/", httponly=True, samesite="strict")
        return response

    def _is_token(self, text: str) -> bool:
        return hmac.compare_digest(text.encode("latin-1", "replace"), self.token.encode())

    def _cookies(self, headers: Headers) -> list[str]:
        # http.cookies fails if another server on this host has set a cookie that it cannot read.
        named = [cookie_parser(header).get(self.cookie) for header in headers.getlist("cookie")]
        return [text for text in named if text is not None]
