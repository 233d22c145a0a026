"""Reading the regions of a domain, which may be anything."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Any

from llm3.interfaces import Domain, Env, Regions
from llm3.testing.conformance.inspection import Fault


def usable_regions(domain: Domain, instance: Any, env: Env) -> Regions:
    """The domain's regions if there is nothing wrong with any of them, and none otherwise."""
    try:
        found = domain.regions(instance)
        return {} if found is None or next(region_faults(env, found), None) else found
    except (Exception, SystemExit):  # a rule tells of it
        return {}


def region_faults(env: Env, found: Any) -> Iterator[Fault]:
    """What is wrong with what `Domain.regions` answers."""
    if not isinstance(found, Mapping):
        yield Fault(
            f"regions must answer a dict or None, not {found!r}.", "It goes by (action, its objects, parameter)."
        )
        return
    ranges = {
        (schema.name, p.name): (len(schema.objects), p.low, p.high) for schema in env.schemas for p in schema.parameters
    }
    for key, region in found.items():
        name, objects, parameter = key if isinstance(key, tuple) and len(key) == 3 else ("", None, "")
        slots, least, most = ranges.get((name, parameter), (-1, 0.0, 0.0))
        if not isinstance(objects, tuple) or len(objects) != slots or not set(objects) <= set(env.objects):
            yield Fault(
                f"a region goes by {key!r}, which is no parameter of this world.",
                "Its key is (action name, tuple of its objects, parameter name), such as ('place', ('box',), 'x').",
            )
        elif not _is_range(region):
            yield Fault(
                f"the region of {key!r} is {region!r}, which is no range.",
                "A region is a pair of finite numbers, the lower one first, such as (0.3, 0.6).",
            )
        elif not least <= region[0] <= region[1] <= most:
            low, high = region
            yield Fault(
                f"the region of {key!r} is {low:g} to {high:g}, and the parameter's range {least:g} to {most:g}.",
                "What is drawn outside of the schema's range is refused as an invalid action.",
            )


def _is_range(region: Any) -> bool:
    return (
        isinstance(region, tuple | list)
        and len(region) == 2
        and all(isinstance(end, int | float) and isfinite(end) for end in region)
        and region[0] <= region[1]
    )
