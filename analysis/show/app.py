"""Web application of `perilune show`: its page, and the answers to requests for counts and trials.

Requests identify campaigns, columns, variants and rows by number; no request names a file.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any
from urllib.parse import quote

import msgspec
import numpy as np
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp

from ...common.errors import InputError
from .binned_columns import MEMORY, BinnedColumns
from .counts import Counter
from .dots import TABLE_LIMIT, trials_document
from .guard import Guard
from .opened_campaign import OpenCampaign, StoppedError
from .query import Query, read_query
from .selected import selected_csv

WORKERS = 2  # requests processed at a time


class Service:
    """Answers to requests about campaigns, computed in separate threads, which end when the server stops."""

    def __init__(self, campaigns: Sequence[OpenCampaign], page: str) -> None:
        self._page = page
        self._columns = [BinnedColumns(campaign, MEMORY / len(campaigns)) for campaign in campaigns]
        self._executor = ThreadPoolExecutor(WORKERS)
        self._free = asyncio.Semaphore(WORKERS)
        for columns in self._columns[:1]:  # read while a browser opens the page
            self._executor.submit(columns.get, list(columns.campaign.quantities)[:1])

    def stop(self) -> None:
        self._executor.shutdown(wait=False, cancel_futures=True)

    async def page(self, _: Request) -> Response:
        return HTMLResponse(self._page)

    async def counts(self, request: Request) -> Response:
        """Answer with the counts of a query."""
        columns, names, query = self._read(request)
        return await self._answer(request, lambda: Counter(columns, names, query).document())

    async def trials(self, request: Request) -> Response:
        """Answer with the first trials that a query selects and the columns of its histograms."""
        columns, names, query = self._read(request)

        def work() -> Any:
            rows = np.flatnonzero(Counter(columns, names, query).select_rows())[:TABLE_LIMIT]
            return trials_document(columns.campaign, rows.tolist(), [names[index] for index in query.histograms])

        return await self._answer(request, work)

    async def selected(self, request: Request) -> Response:
        """Answer with a file of all selected trials and all columns."""
        columns, names, query = self._read(request)
        mask = await asyncio.get_running_loop().run_in_executor(
            self._executor, lambda: Counter(columns, names, query).select_rows()
        )
        name = f"{columns.campaign.source.folder.name}-selected.csv"
        headers = {"content-disposition": f"attachment; filename*=UTF-8''{quote(name, safe='')}"}
        return StreamingResponse(selected_csv(columns.campaign, mask, names), media_type="text/csv", headers=headers)

    async def trial(self, request: Request) -> Response:
        """Answer with all numbers of the trial in a row of the campaign."""
        columns, names = self._campaign(request)
        row = request.path_params["row"]
        if row >= columns.campaign.rows:
            raise HTTPException(404)
        return await self._answer(request, lambda: trials_document(columns.campaign, [row], names)[0])

    def _campaign(self, request: Request) -> tuple[BinnedColumns, list[str]]:
        """Return the campaign with this number, and the names of its columns."""
        number = request.path_params["campaign"]
        if number >= len(self._columns):
            raise HTTPException(404)
        columns = self._columns[number]
        return columns, list(columns.campaign.quantities)

    def _read(self, request: Request) -> tuple[BinnedColumns, list[str], Query]:
        columns, names = self._campaign(request)
        text = request.query_params.get("query", "{}")
        return columns, names, read_query(text, len(names), len(columns.campaign.variants))

    async def _answer(self, request: Request, work: Callable[[], Any]) -> Response:
        """Answer with the result of ``work`` as JSON, or skip it if the page disconnected while waiting."""
        async with self._free:
            if await request.is_disconnected():
                return Response(status_code=204)
            document = await asyncio.get_running_loop().run_in_executor(self._executor, work)
        return Response(msgspec.json.encode(document), media_type="application/json")


async def _refuse(_: Request, error: Exception) -> Response:
    """Answer with one line that states the problem of a request or a file."""
    return PlainTextResponse(str(error), 422)


async def _end(_: Request, __: Exception) -> Response:
    return PlainTextResponse("perilune show is stopping", 503)


def make_app(service: Service, authority: str, token: str) -> ASGIApp:
    """Return the guarded application; ``authority`` is the host and port of its address."""
    app = Starlette(
        routes=[
            Route("/", service.page),
            Route("/campaigns/{campaign:int}/counts", service.counts),
            Route("/campaigns/{campaign:int}/trials", service.trials),
            Route("/campaigns/{campaign:int}/selected.csv", service.selected),
            Route("/campaigns/{campaign:int}/trials/{row:int}", service.trial),
        ],
        exception_handlers={InputError: _refuse, StoppedError: _end},
    )
    app.router.redirect_slashes = False
    return Guard(app, authority, token)
