"""When everything is where it belongs."""

from __future__ import annotations

from llm3.types import GoalStatus, Pose, State
from llm3_tabletop2d.instance import TOLERANCE, ObjectSpec, RectangleSpec, TabletopInstance
from llm3_tabletop2d.scene import turn_of


def goal_status(instance: TabletopInstance, state: State) -> GoalStatus:
    """Every object that has a goal lies in its region with its whole outline, within `TOLERANCE`, and is not held."""
    unmet = []
    for item in instance.objects:
        region = instance.region_of(item.name)
        if region:
            unmet.append(_unmet(item, region, state.poses.get(item.name)))
    missing = tuple(filter(None, unmet))
    return GoalStatus(not missing, missing)


def _unmet(item: ObjectSpec, region: RectangleSpec, pose: Pose | None) -> str:
    if pose is None:
        return f"{item.name} is still held"
    reach = item.extent(turn_of(pose))
    beyond = max(
        abs(p - center) + (length - side) / 2
        for p, center, length, side in zip(pose.position, region.center, reach, region.size, strict=False)
    )
    if beyond <= TOLERANCE:
        return ""
    if beyond >= min(reach):
        return f"{item.name} is not in {region.name}"
    return f"{item.name} reaches {beyond * 1000:.0f} mm out of {region.name}"
