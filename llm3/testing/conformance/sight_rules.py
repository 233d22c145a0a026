"""Rules for what a domain shows: its scenery and its stage."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.errors import MissingDependency
from llm3.interfaces import Picture, Scenery, Stage
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.world import World
from llm3.types import Body, State, moment_of

WIDTH, HEIGHT = 64, 48
"""Of the pictures that are taken, in pixels."""
LOOKED_AT = 6
"""How many states are looked at besides the start."""
EXACT = 1e-6
"""What may be lost by rounding in a matrix."""
FARTHER = 0.002
"""What moved by more than this, in metres, has to be seen elsewhere."""


def the_scenery_shows_where_everything_is(world: World) -> Iterator[Fault]:
    """A scenery has a body for each object, by its name, and tells the poses of bodies that there are."""
    try:
        scenery = world.domain.scenery(world.instance, world.options)
    except MissingDependency:
        return  # what cannot be shown here cannot be looked at
    if scenery is None:
        return
    if not isinstance(scenery, Scenery):
        yield Fault(f"scenery must answer a Scenery or None, not {scenery!r}.", "It answers an instance.")
        return
    bodies = scenery.bodies
    if not isinstance(bodies, tuple) or not all(isinstance(body, Body) for body in bodies):
        yield Fault(f"bodies must be a tuple of Body, not {bodies!r}.", "A tuple needs a comma.")
        return
    names = [body.name for body in bodies]
    if len(set(names)) < len(names):
        yield Fault(f"the scenery has two bodies of one name: {', '.join(names)}.", "What fails goes by the names.")
        return
    for state in _states(world):
        yield from _misplaced(world, scenery, names, state)


def _misplaced(world: World, scenery: Scenery, names: list[str], state: State) -> Iterator[Fault]:
    places = scenery.places(moment_of(state))
    begun = scenery.places(moment_of(world.start))
    for name in places:
        if name not in names:
            yield Fault(f"the scenery tells where {name} is, which is none of its bodies.", "bodies has every body.")
            return
    for name in (*state.poses, *((state.held.object,) if state.held else ())):
        if name not in names:
            yield Fault(
                f"the scenery has no body for {name}.", "A body has the name that the state has for the object."
            )
        elif name not in places:
            yield Fault(
                f"the scenery does not tell where {name} is{' when it is held' * (name not in state.poses)}.",
                "A moment has what stands in poses, and what is held in held, in the tool's frame.",
            )
        elif not _is_pose(places[name]):
            yield Fault(
                f"the scenery's frame of {name} is no pose.",
                "It is a 4 by 4 matrix: a rotation, a position in metres, and 0, 0, 0, 1 below.",
            )
        elif name in state.poses and name in world.start.poses and name in begun:
            before, after = (np.array(s.poses[name].position) for s in (world.start, state))
            way, seen = (float(np.linalg.norm(v)) for v in (after - before, (places[name] - begun[name])[:3, 3]))
            if way > FARTHER and seen < way / 2:
                yield Fault(
                    f"the scenery shows {name} {seen * 1000:.0f} mm from its start, and it is {way * 1000:.0f} mm off.",
                    "Where a body is has to be read from the moment.",
                )


def _is_pose(frame: object) -> bool:
    matrix = np.asarray(frame)
    if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
        return False
    turn = matrix[:3, :3]
    upright = np.allclose(turn @ turn.T, np.eye(3), atol=EXACT) and np.linalg.det(turn) > 0
    return bool(upright and np.allclose(matrix[3], (0, 0, 0, 1), atol=EXACT))


def the_stage_shows_one_moment_in_one_way(world: World) -> Iterator[Fault]:
    """A stage takes pictures of the size that is asked for, the same of the same moment, whatever it showed before."""
    try:
        stage = world.domain.stage(world.instance, world.options, False)
    except MissingDependency:
        return
    if stage is None:
        return
    if not isinstance(stage, Stage):
        yield Fault(f"stage must answer a Stage or None, not {stage!r}.", "It answers an instance.")
        return
    states = _states(world)
    try:
        taken: dict[State, Picture] = {}
        for state in (*states, *reversed(states)):
            stage.show(moment_of(state))
            picture = np.asarray(stage.picture(WIDTH, HEIGHT))
            if picture.shape != (HEIGHT, WIDTH, 3) or picture.dtype != np.uint8:
                yield Fault(
                    f"a picture of {WIDTH} by {HEIGHT} pixels is an array {picture.shape} of {picture.dtype}.",
                    "It has to be (height, width, 3) of uint8: red, green and blue from 0 to 255.",
                )
                return
            if not np.array_equal(taken.setdefault(state, picture), picture):
                yield Fault(
                    "the stage shows one state in two ways.",
                    "Something of what it showed before is left: show has to move, or hide, all that a moment tells.",
                )
                return
    finally:
        stage.close()
    stage.close()  # twice does no harm


def _states(world: World) -> list[State]:
    applied = (trial.transition.state for trial in world.applied if trial.transition)
    return list(dict.fromkeys((world.start, *applied)))[: LOOKED_AT + 1]


RULES = (the_scenery_shows_where_everything_is, the_stage_shows_one_moment_in_one_way)
