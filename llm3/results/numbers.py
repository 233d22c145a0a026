"""How figures are written."""

from __future__ import annotations

from llm3.results.estimates import Estimate

NOTHING = "-"
WHOLE_FROM = 1000
"""Larger numbers are written without decimals."""


def percent(share: float) -> str:
    """A share in percent, with a decimal if it has one."""
    return f"{100 * share:.1f}".removesuffix(".0")


def decimal(value: float) -> str:
    """A count or a number of seconds, with one decimal."""
    return f"{round(value, 1) + 0.0:.1f}" if abs(value) < WHOLE_FROM else f"{value:.0f}"  # no -0.0


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


def plural(number: int, noun: str) -> str:
    """A number and what it counts."""
    return f"{number} {noun}{'s' * (number != 1)}"
