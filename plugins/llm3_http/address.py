"""Where the server is."""

from __future__ import annotations

import re
from urllib.parse import urlsplit

from llm3.errors import UsageError
from llm3_http.secret import MASK
from llm3_http.wording import cut

_PORTS = {"http": 80, "https": 443}


def checked_address(url: str, source: str) -> str:
    """The base address of an API, without a slash at its end.

    Args:
        url: The address.
        source: Where it stands, for the error.

    Raises:
        UsageError: It is no http or https address, or it holds more than scheme, host, port and path.
    """
    try:
        parts = urlsplit(url)
        usable = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:  # urlsplit's word for a bad port or a bad IPv6 address
        usable = False
    # Parsers differ on what these characters mean, so the host that is checked might not be the host that is asked.
    if not usable or not url.isascii() or not url.isprintable() or re.search(r"[\s\\]", url):
        raise UsageError(_refusal(source, url, "be an http:// or https:// address, such as http://127.0.0.1:11434/v1"))
    if "@" in parts.netloc:
        raise UsageError(_refusal(source, url, "hold no user name and no password: give the key in LLM3_API_KEY"))
    if "?" in url or "#" in url:
        raise UsageError(_refusal(source, url, "have no query and no fragment: give the key in LLM3_API_KEY"))
    return url.rstrip("/")


def same_address(one: str, other: str) -> bool:
    """Whether two checked addresses lead to the same place: scheme, host, port and path."""

    def place(url: str) -> tuple[object, ...]:
        parts = urlsplit(url)
        return parts.scheme, parts.hostname, parts.port or _PORTS[parts.scheme], parts.path

    return place(one) == place(other)


def masked(url: str) -> str:
    """The address without what could be a secret in it: credentials, query and fragment."""
    # From the scheme to the last @, since a password may hold any character.
    without_user = re.sub(r"^([a-zA-Z][a-zA-Z0-9+.-]*://)?.*@", rf"\1{MASK}@", url, flags=re.DOTALL)
    return re.sub(r"([?#]).*", rf"\1{MASK}", without_user, flags=re.DOTALL)


def _refusal(source: str, url: str, demand: str) -> str:
    return f"{source} is {cut(repr(masked(url)))}, but must {demand}"
