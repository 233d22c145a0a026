"""The kitchen world."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    Failure,
    FrozenDict,
    GoalStatus,
    Motion,
    MotionProblem,
    NoMotion,
    State,
    Transition,
)
from llm3_bullet.tabletop.env import TabletopEnv
from llm3_bullet.tabletop.manipulation import Manipulation, precondition
from llm3_bullet.tabletop.table import support_height
from llm3_bullet.tabletop.tabletop import Tabletop
from llm3_bullet.workcell import Workcell
from llm3_kitchen.actions import HEAT, PICK, PLACE, WASH
from llm3_kitchen.chores import chore
from llm3_kitchen.facts import HEATED, WASHED, at_first, made_true
from llm3_kitchen.goal import goal_status
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.layout import furniture, surfaces
from llm3_kitchen.looks import CAMERA, COLORS, marks
from llm3_kitchen.wording import describe, task_text

DEEDS = {WASH.name: WASHED, HEAT.name: HEATED}
"""What becomes of the food, by the action."""


class KitchenEnv(TabletopEnv):
    """Food among clutter, places where something can be done with it, and an arm."""

    camera = CAMERA

    def __init__(self, instance: KitchenInstance, workcell: Workcell) -> None:
        """Set up the world.

        Args:
            instance: The problem.
            workcell: The robot and its simulators; the Env owns them from now on.

        Raises:
            InputError: It cannot begin, or not with this robot; see `Tabletop`.
        """
        self._instance = instance
        self._places = {place.name: place for place in instance.places}
        high = surfaces(instance.places)
        things = (thing.standing(support_height(high, thing.footprint)) for thing in instance.things)
        areas = {place.name: place.area for place in instance.places}
        fixed = furniture(instance.places)
        super().__init__(Tabletop(workcell, fixed, things, high, areas, instance.to_move, instance.to_reach))
        self._in_hand = Manipulation(self.tabletop.sizes, (), workcell.gripper).in_hand
        marked = dict(marks(instance.places))
        self.marks = tuple(marked)
        self.colors = FrozenDict({**COLORS, **{mark.name: color for mark, color in marked.items()}})

    @property
    def task(self) -> str:
        """The task in prose."""
        return task_text(self.tabletop.workcell.gripper)

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """Pick, place, wash and heat."""
        return PICK, PLACE, WASH, HEAT

    @property
    def objects(self) -> tuple[str, ...]:
        """The food, the clutter and the places."""
        return (*super().objects, *self._places)

    def reset(self) -> State:
        """Everything at its start, nothing washed or heated."""
        return replace(super().reset(), facts=at_first(food.name for food in self._instance.foods))

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The places and the things, to the millimetre."""
        return describe(self._instance, state)

    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | NoMotion | Failure:
        """A path to above the thing or the spot; nothing for a chore."""
        name, *rest = action.objects
        if name in self._places:
            return precondition(f"{name} is a place, so you cannot {action.name} it.", name)
        if action.name == PICK.name:
            return self.tabletop.pick(state, name, rng)
        if action.name == PLACE.name:
            refusal = self._misplaced(state, name, rest[0], **action.params)
            return refusal or self.tabletop.place(state, name, **action.params, rng=rng)
        return chore(self._instance, state, name, DEEDS[action.name])

    def _misplaced(self, state: State, name: str, where: str, x: float, y: float, theta: float) -> Failure | None:
        """Why a thing cannot be put down there before anything is said of motions; None if it can."""
        if where not in self._places:
            return precondition(f"{where} is no place: the places are {', '.join(self._places)}.", where)
        box = self._in_hand(state, name)
        if isinstance(box, Failure):
            return box
        place, footprint = self._places[where], box.standing.footprint((x, y), theta)
        if place.holds(footprint):
            return None
        if not place.area.overlaps(footprint):
            return precondition(f"At this spot, {name} would not be in {where}.", name)
        beyond = max(1.0, place.area.overhang(footprint) * 1000)
        return precondition(f"At this spot, {name} would reach {beyond:.0f} mm out of {where}.", name)

    def apply(self, state: State, action: Action, motion: Motion) -> Transition:
        """The food washed or heated, or what a pick or a place leaves."""
        if action.name in DEEDS:
            facts = made_true(state, action.objects[0], DEEDS[action.name])
            return Transition(replace(state, facts=facts))
        return super().apply(state, action, motion)

    def goal(self, state: State) -> GoalStatus:
        """Every food prepared as it should be, and served."""
        return goal_status(self._instance, state)
