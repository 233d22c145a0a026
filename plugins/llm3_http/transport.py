"""One request and its answer."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import requests
import urllib3.exceptions
from requests.auth import AuthBase

from llm3.errors import BackendError
from llm3_http.dialect import Dialect
from llm3_http.retry import TryAgain
from llm3_http.secret import Secret
from llm3_http.settings import HttpSettings
from llm3_http.watchdog import Watchdog
from llm3_http.wording import quoted, seconds

_PIECE = 65_536
"""Bytes read at a time."""
_SHORTEST = 0.001
"""Seconds. The sockets take no timeout of zero, and a sleep may have overrun the deadline."""


@dataclass(frozen=True)
class Reply:
    """What a server sent back."""

    status: int
    headers: Mapping[str, str]
    """Names in any case."""
    body: bytes
    """Whole where the status is 2xx, else what could be read of its beginning."""


class Key(AuthBase):
    """Sends the key, if there is one, and nothing else.

    With an authentication of its own, requests does not look for one in ``.netrc``; proxies and certificates from
    the environment stay in use.
    """

    def __init__(self, key: Secret, dialect: Dialect) -> None:
        self._key, self._dialect = key, dialect

    def __call__(self, request: requests.PreparedRequest) -> requests.PreparedRequest:
        """Add the header."""
        if self._key:
            request.headers[self._dialect.key_header] = f"{self._dialect.key_prefix}{self._key.reveal()}"
        return request


def exchange(
    session: requests.Session,
    watchdog: Watchdog,
    settings: HttpSettings,
    dialect: Dialect,
    payload: Mapping[str, Any],
    *,
    until: float,
    clock: Callable[[], float],
) -> Reply:
    """Send one request and read its answer.

    The whole answer must arrive before the time is over, or the connection is cut off.

    Args:
        session: Where connections are kept.
        watchdog: Of the session.
        settings: The server and its limits.
        dialect: How it is spoken to.
        payload: The request's JSON.
        until: When the answer must be here at the latest, by the clock; the settings' read timeout may come first.
        clock: Monotonic seconds.

    Raises:
        TryAgain: No answer, in a way that may pass.
        BackendError: No answer, and none to be expected.
    """
    start = clock()
    limit = max(_SHORTEST, min(settings.read_timeout, until - start))
    with watchdog.cutting_off_after(limit) as alarm:
        try:
            with session.post(
                f"{settings.base_url}{dialect.path}",
                json=payload,
                # Answers are short, and a compressed one could be a bomb.
                headers={"Accept": "application/json", "Accept-Encoding": "identity", **dialect.headers},
                auth=Key(settings.key, dialect),
                timeout=(min(settings.connect_timeout, limit), limit),
                allow_redirects=False,
                stream=True,
            ) as response:
                pieces = _pieces(response, lambda: alarm.went_off or clock() - start > limit)
                body = _whole(pieces, settings) if 200 <= response.status_code < 300 else _beginning(pieces)
                if alarm.went_off:
                    raise requests.ReadTimeout
                return Reply(response.status_code, response.headers, body)
        except (OSError, urllib3.exceptions.HTTPError) as error:
            # The library's own words may quote the server, and the server the key: they end here.
            raise _failure(requests.ReadTimeout() if alarm.went_off else error, settings, limit) from None


def _pieces(response: requests.Response, late: Callable[[], bool]) -> Iterator[bytes]:
    # read1 hands over what has arrived, where requests' iter_content waits until a piece is full.
    while piece := response.raw.read1(_PIECE, decode_content=True):
        yield piece
        if late():
            raise requests.ReadTimeout


def _whole(pieces: Iterator[bytes], settings: HttpSettings) -> bytes:
    body = bytearray()
    for piece in pieces:
        body += piece
        if len(body) > settings.max_body:
            raise BackendError(
                f"the server at {settings.base_url} sent more than {settings.max_body} bytes: "
                "check LLM3_BASE_URL and --model"
            )
    return bytes(body)


def _beginning(pieces: Iterator[bytes]) -> bytes:
    body = bytearray()
    # The status is the answer; what explains it may be missing.
    with suppress(OSError, urllib3.exceptions.HTTPError):
        for piece in pieces:
            body += piece
            if len(body) > _PIECE:
                break
    return bytes(body)


def _failure(error: Exception, settings: HttpSettings, limit: float) -> TryAgain | BackendError:
    base = settings.base_url
    if isinstance(error, requests.exceptions.ProxyError):
        return TryAgain(
            f"no proxy answers on the way to {base}: check HTTP_PROXY, HTTPS_PROXY and NO_PROXY", "no proxy answered"
        )
    if isinstance(error, requests.exceptions.SSLError):
        return BackendError(
            f"no TLS connection to {base}: check LLM3_BASE_URL and the server's certificate"
            f"{quoted(settings.clean(str(_reason(error))))}"
        )
    if isinstance(error, requests.ConnectTimeout):
        wait = seconds(min(settings.connect_timeout, limit))
        return TryAgain(
            f"no server answers at {base} within {wait}: start it, or set LLM3_BASE_URL", "no server answered"
        )
    if isinstance(_reason(error), urllib3.exceptions.NewConnectionError):
        return TryAgain(f"no server answers at {base}: start it, or set LLM3_BASE_URL", "no server answered")
    if isinstance(error, (requests.Timeout, urllib3.exceptions.ReadTimeoutError)):
        return TryAgain(
            f"the server at {base} did not answer in full within {seconds(limit)}: "
            "try again later, or give another --model",
            f"no answer in full within {seconds(limit)}",
        )
    if isinstance(
        error,
        (
            requests.ConnectionError,
            urllib3.exceptions.ProtocolError,
            urllib3.exceptions.DecodeError,
            urllib3.exceptions.SSLError,
        ),
    ):
        return TryAgain(
            f"the server at {base} broke off its answer: try again later, or look into the server's log",
            "the answer broke off",
        )
    return BackendError(
        f"no request can be made to {base} ({type(error).__name__}): "
        "check LLM3_BASE_URL and the settings of proxies and certificates"
    )


def _reason(error: Exception) -> object:
    """Why urllib3 gave up, which requests hands on as the first argument of its own error."""
    return getattr(error.args[0], "reason", error.args[0]) if error.args else None
