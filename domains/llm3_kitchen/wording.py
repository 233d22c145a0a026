"""What a model is told of the task and the world."""

from __future__ import annotations

from llm3.types import Entity, State
from llm3_bullet.robot import Gripper
from llm3_bullet.tabletop.box_spec import BoxSpec
from llm3_bullet.tabletop.wording import box_entity, gripper_text, hand_text
from llm3_kitchen.facts import HEATED, WASHED, is_true
from llm3_kitchen.instance import RIM_THICKNESS, FoodSpec, KitchenInstance, PlaceSpec
from llm3_kitchen.layout import PLATE_HEIGHT, RIM_HEIGHT
from llm3_kitchen.whereabouts import place_of


def task_text(gripper: Gripper) -> str:
    """The task in prose; lengths are those of the robot in use."""
    return (
        "A robot arm prepares a meal in a kitchen. The arm stands at (0, 0) and faces the positive x axis; y points to "
        "its left and z points up. The table's surface is at z = 0. Lengths are in metres, angles in radians.\n"
        "The table has places, each of a kind, such as a sink: rectangles whose sides are parallel to x and y. What is "
        "put down must stand in a place with its whole footprint, and not on something else. Sink and stove are "
        "small, so clear them after use. Around a sink is a rim "
        f"{RIM_HEIGHT:g} m high and {RIM_THICKNESS:g} m thick, which the fingers must not touch; a sink's floor is the "
        f"table. A stove is a plate {PLATE_HEIGHT:g} m high.\n"
        "The goal: every food is washed and heated as far as the state asks for it, and then stands in a serving "
        "place. Food is washed in a sink and heated on a stove, and must be washed before it is heated. Clutter is "
        "only in the way: it may be moved to any place.\n"
        f"{gripper_text(gripper, 'object')} {hand_text(gripper, 'object')}"
    ).rstrip()


def describe(instance: KitchenInstance, state: State) -> tuple[Entity, ...]:
    """The places and the things, to the millimetre."""
    foods = (_food(instance, state, food) for food in instance.foods)
    clutter = (_thing(instance, state, thing, kind="clutter") for thing in instance.clutter)
    return (*map(_place, instance.places), *foods, *clutter)


def _place(place: PlaceSpec) -> Entity:
    x, y = (
        (round(middle - side / 2, 3) + 0.0, round(middle + side / 2, 3) + 0.0)
        for middle, side in zip(place.center, place.size, strict=True)
    )
    return Entity(place.name, {"kind": place.kind, "x range": x, "y range": y})


def _food(instance: KitchenInstance, state: State, food: FoodSpec) -> Entity:
    wanted = [deed for deed, asked in ((WASHED, food.washed), (HEATED, food.heated)) if asked]
    done = ", ".join(deed for deed in (WASHED, HEATED) if is_true(state, food.name, deed)) or "nothing"
    return _thing(instance, state, food, kind="food", goal=", ".join((*wanted, "served")), done=done)


def _thing(instance: KitchenInstance, state: State, thing: BoxSpec, **others: str) -> Entity:
    where = {}
    if thing.name in state.poses:
        place = place_of(instance, state, thing.name, thing.size)
        where = {"stands in": place.name if place else "no place"}
    return box_entity(thing.name, thing.size, state.poses.get(thing.name), **where, **others)
