"""Client of a campaign served by `show`, without browser and network."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from typing import Any

from httpx import ASGITransport, AsyncClient, Response

from perilune.analysis.show.app import Service, make_app
from perilune.analysis.show.opened_campaign import open_campaign

AUTHORITY, TOKEN = "127.0.0.1:4711", "right-token"
COOKIE = f"perilune-4711={TOKEN}"
PAGE = "the page"


def request(service: Service, method: str, path: str, **options: Any) -> Response:
    """Return the answer of the guarded application; redirects are not followed."""

    async def send() -> Response:
        transport = ASGITransport(make_app(service, AUTHORITY, TOKEN))
        async with AsyncClient(transport=transport, base_url=f"http://{AUTHORITY}") as client:
            return await client.request(method, path, **options)

    return asyncio.run(send())


class ShowClient:
    """The application over one folder, and requests that have the cookie."""

    def __init__(self, folder: Path) -> None:
        self.campaign = open_campaign(folder, lambda: False)
        self.names = list(self.campaign.quantities)
        self.service = Service([self.campaign], PAGE)

    def get(self, path: str, **options: Any) -> Response:
        return request(self.service, "GET", path, headers={"cookie": COOKIE}, **options)

    def query(self, path: str, **query: Any) -> Response:
        return self.get(f"/campaigns/0/{path}", params={"query": json.dumps(query)})

    def numbers(self, *names: str) -> list[int]:
        """Return the numbers by which queries call columns."""
        return [self.names.index(name) for name in names]
