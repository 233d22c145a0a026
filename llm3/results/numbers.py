"""How figures are written."""

from __future__ import annotations

from decimal import ROUND_HALF_UP, Decimal

from llm3.results.estimates import Estimate

NOTHING = "-"
WHOLE_FROM = 1000
"""Larger numbers are written without decimals."""


def percent(share: float) -> str:
    """A share in percent, with a decimal if it has one; only all and nothing are 100 and 0."""
    text = _rounded(100 * share, 1).removesuffix(".0")
    return text if share in (0, 1) or text not in ("0", "100") else f"{100 * share:.3g}" if share < 0.5 else ">99.9"


def decimal(value: float) -> str:
    """A count or a number of seconds, with one decimal while it is small."""
    text = _rounded(value, 1)
    return text if abs(float(text)) < WHOLE_FROM else _rounded(value, 0)


def _rounded(value: float, digits: int) -> str:
    """Rounded as in school: a half goes away from zero. No -0."""
    step = Decimal(1).scaleb(-digits)
    return f"{Decimal(repr(float(value))).quantize(step, ROUND_HALF_UP) + Decimal(0):.{digits}f}".replace("-0.0", "0.0")


def figure(value: float, measure: str) -> str:
    """The value of a measure."""
    return percent(value) if measure == "success" else decimal(value)


def with_interval(estimate: Estimate | None, measure: str) -> str:
    """A figure and its interval in brackets."""
    if estimate is None:
        return NOTHING
    ends = [_exact(end, measure) for end in estimate.interval] if estimate.interval else [NOTHING]
    return f"{_exact(estimate.mean, measure)} [{', '.join(ends)}]"


def difference_with_interval(estimate: Estimate, measure: str) -> str:
    """The same with signs; a difference of shares is in percentage points."""
    ends = [_signed(_exact(end, measure)) for end in estimate.interval] if estimate.interval else [NOTHING]
    return f"{_signed(_exact(estimate.mean, measure))} [{', '.join(ends)}]"


def p_value(p: float) -> str:
    """Three decimals, or that it is less."""
    return "<0.001" if p < 0.0005 else f"{p:.3f}"


def _exact(value: float, measure: str) -> str:
    return decimal(100 * value if measure == "success" else value)


def _signed(text: str) -> str:
    return text if text.startswith("-") else f"+{text}"
