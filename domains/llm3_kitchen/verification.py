"""A second look at kitchen plans: each action does what it says, where it may, and the meal is served in the end."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.interfaces import PlanVerifier
from llm3.types import Action, PlannedAction, State, Verification
from llm3_bullet.robot import RobotDescription
from llm3_bullet.verification import Playback, check_let_go, check_pick, check_place, second_look
from llm3_kitchen.actions import HEAT, PICK, PLACE, WASH
from llm3_kitchen.instance import KitchenInstance, PlaceSpec
from llm3_kitchen.layout import furniture

OUT_OF_PLACE = 0.001
"""How far something may reach out of the place in which it stands, in metres."""


class KitchenVerifier(PlanVerifier):
    """Plays plans of one instance."""

    def __init__(self, instance: KitchenInstance, robot: RobotDescription) -> None:
        """Take the problem.

        Args:
            instance: The places and the things.
            robot: What prepares the meal.
        """
        self._instance, self._robot = instance, robot

    def verify(self, start: State, actions: tuple[PlannedAction, ...]) -> Verification:
        """Play the plan in a world of its own."""
        sizes = {thing.name: thing.size for thing in self._instance.things}
        look = _Look(self._instance, start, iter(actions))
        fixed = furniture(self._instance.places)
        return second_look(self._robot, fixed, sizes, start, actions, look.check_deed, look.check_goal)


class _Look:
    """Keeps its own account of what was washed and heated, as a plan is played."""

    def __init__(self, instance: KitchenInstance, start: State, steps: Iterator[PlannedAction]) -> None:
        self._instance, self._facts, self._steps = instance, dict(start.facts), steps
        self._done: set[tuple[str, str]] = set()

    def check_deed(self, playback: Playback, action: Action) -> None:
        """See that the motion did what the action says, and nothing but that became true."""
        step = next(self._steps)
        name = action.objects[0] if action.objects else ""
        if action.name == PICK.name and len(action.objects) == 1:
            check_pick(playback, name)
        elif action.name == PLACE.name and len(action.objects) == 2:
            self._check_place(playback, action)
        elif action.name in (WASH.name, HEAT.name) and name in {food.name for food in self._instance.foods}:
            self._check_chore(playback, step)
        self._check_facts(playback, step.state)

    def check_goal(self, playback: Playback) -> None:
        """See that every food was washed and heated as it should be, and stands in a serving place."""
        tell = playback.findings.tell
        for food in self._instance.foods:
            for wanted, deed, done in ((food.washed, WASH.name, "washed"), (food.heated, HEAT.name, "heated")):
                if wanted and (food.name, deed) not in self._done:
                    tell(f"{food.name} was never {done}")
            if food.name == playback.world.held:
                tell(f"{food.name} ends in the gripper")
            elif not self._stands_in(playback, food.name, "serving"):
                tell(f"{food.name} does not end in a serving place")

    def _check_place(self, playback: Playback, action: Action) -> None:
        name, where = action.objects
        if set(action.params) == {"x", "y", "theta"}:
            check_place(playback, name, **action.params)
        else:
            check_let_go(playback, name)
        place = next((place for place in self._instance.places if place.name == where), None)
        if place and name in playback.let_go and playback.world.held != name:
            out = _out_of(place, playback, name)
            if out > OUT_OF_PLACE:
                playback.findings.tell(f"{name} reaches {out * 1000:.1f} mm out of {where}", distance=out)

    def _check_chore(self, playback: Playback, step: PlannedAction) -> None:
        name, deed, tell = step.action.objects[0], step.action.name, playback.findings.tell
        if step.motion.segments:
            tell("the arm moves, and has nothing to do here")
        if playback.world.held:
            tell(f"the gripper holds {playback.world.held}, and must be empty")
        kind = "sink" if deed == WASH.name else "stove"
        if playback.world.held != name and not self._stands_in(playback, name, kind):
            tell(f"{name} does not stand in a place of the kind {kind!r}")
        if deed == HEAT.name and (name, WASH.name) not in self._done:
            tell(f"{name} was not washed before")
        self._done.add((name, deed))
        self._facts[f"{name} {'washed' if deed == WASH.name else 'heated'}"] = True

    def _check_facts(self, playback: Playback, state: State) -> None:
        """Each fact that the state after the action does not say right."""
        for fact in sorted({*self._facts, *state.facts}):
            said, true = state.facts.get(fact), self._facts.get(fact)
            if said != true:
                playback.findings.tell(f"the state after it says {said} of {fact!r}, and it should be {true}")
        self._facts = dict(state.facts)

    def _stands_in(self, playback: Playback, name: str, kind: str) -> bool:
        return any(_out_of(place, playback, name) <= OUT_OF_PLACE for place in self._instance.of_kind(kind))


def _out_of(place: PlaceSpec, playback: Playback, name: str) -> float:
    """How far something reaches out of a place, in metres; negative inside."""
    corners = playback.world.corners(name)[:, :2]
    return float((np.abs(corners - np.array(place.center)) - np.array(place.size) / 2).max())
