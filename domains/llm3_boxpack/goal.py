"""When the boxes are packed."""

from __future__ import annotations

from llm3.types import GoalStatus, Pose, State
from llm3_boxpack.instance import TOLERANCE, BoxpackInstance, BoxSpec
from llm3_bullet.tabletop.stance import shadow


def goal_status(instance: BoxpackInstance, state: State) -> GoalStatus:
    """Every box lies in the basket with its whole footprint, within `TOLERANCE`, and none is held."""
    sentences = (_unmet(instance, box, state.poses.get(box.name)) for box in instance.boxes)
    unmet = tuple(sentence for sentence in sentences if sentence)
    return GoalStatus(not unmet, unmet)


def _unmet(instance: BoxpackInstance, box: BoxSpec, pose: Pose | None) -> str:
    if pose is None:
        return f"{box.name} is still in the gripper"
    area, covered = instance.basket.area, shadow(pose, box.size)
    if not area.overlaps(covered):
        return f"{box.name} is not in the basket"
    beyond = area.overhang(covered)
    return f"{box.name} reaches {beyond * 1000:.0f} mm out of the basket" if beyond > TOLERANCE else ""
