"""What a model is told of the task and the world."""

from __future__ import annotations

from llm3.types import Entity, State
from llm3_tabletop2d.actions import LARGEST_CARRIED
from llm3_tabletop2d.instance import Pair, RectangleSpec, TabletopInstance
from llm3_tabletop2d.scene import turn_of


def task_text(radius: float) -> str:
    """The task in prose, for a robot with this radius in metres."""
    robot = f"a disc of radius {radius:g} m" if radius else "a point"
    return (
        "A robot moves things on a table, seen from above: x points to the right, y points up. Lengths are in metres, "
        f"angles in radians. The robot is {robot}, and moves in any direction without turning. Walls are fixed; "
        "outer_wall is around the room. Objects are discs and boxes. They keep their orientation, because the robot "
        "does not turn.\n"
        "The goal: every object that belongs in a region lies in it with its whole outline, and is not held. The other "
        "objects may be anywhere, and may be moved out of the way.\n"
        "The robot stands beside an object to take hold of it, on the side that the angle of the pick names, and the "
        "object stays on that side of it until it is placed. So the robot and the object that it carries must both fit "
        "through a gap, and both need room where the object is placed. The robot carries one object at a time, whose "
        f"longest side is {LARGEST_CARRIED:g} m at most. Larger objects can only be pushed. To push an object, the "
        "robot stands behind it, so it needs room there, and nothing may be on the straight way of the two."
    )


def describe(instance: TabletopInstance, state: State) -> tuple[Entity, ...]:
    """The room and what is in it, to the millimetre."""
    x, y = state.configuration
    robot = Entity("robot", {"position": _millimetres((x, y)), "holds": state.held.object if state.held else "nothing"})
    room = Entity("room", {"x range": (0.0, instance.room[0]), "y range": (0.0, instance.room[1])})
    entities = [room, *map(_ranges, instance.walls), *map(_ranges, instance.regions), robot]
    for item in instance.objects:
        pose = state.poses.get(item.name)
        shape = {"diameter": item.size[0]} if item.shape == "disc" else {"size": item.size}
        region = instance.region_of(item.name)
        if pose:
            where = {"position": _millimetres(pose.position[:2])}
            turn = turn_of(pose)
        else:
            grasp = state.held.grasp if state.held else None
            if grasp is None:
                raise ValueError(f"{item.name} is neither held nor anywhere")
            where = {"position": _millimetres((x + grasp.position[0], y + grasp.position[1]))}
            turn = turn_of(grasp)
        theta = {} if item.shape == "disc" else {"theta": round(turn, 3) + 0.0}
        goal = {"belongs in": region.name} if region else {}
        entities.append(Entity(item.name, {"shape": item.shape, **shape, **where, **theta, **goal}))
    return tuple(entities)


def _ranges(thing: RectangleSpec) -> Entity:
    x, y = thing.ranges
    return Entity(thing.name, {"x range": _millimetres(x), "y range": _millimetres(y)})


def _millimetres(point: tuple[float, ...]) -> Pair:
    return round(point[0], 3) + 0.0, round(point[1], 3) + 0.0
