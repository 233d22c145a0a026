"""A problem and its solution while they are being made, and the proof that the solution is one for the hand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from llm3.types import Action
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.spots import is_within_reach
from llm3_boxpack.families.standing import QUARTER_TURN, Standing
from llm3_boxpack.families.tray import Tray
from llm3_boxpack.instance import BasketSpec, BoxpackInstance, BoxSpec, ClutterSpec


@dataclass(frozen=True)
class Draft:
    """Where everything starts, and where it goes one after another."""

    tray: Tray
    boxes: tuple[Standing, ...]
    """What is to be packed, where it starts."""
    moves: tuple[Standing, ...]
    """Where boxes and things go, in this order."""
    clutter: tuple[Standing, ...] = ()
    """What is not to be packed, where it starts."""

    @property
    def start(self) -> dict[str, Standing]:
        """Where everything starts, by name."""
        return {thing.name: thing for thing in (*self.boxes, *self.clutter)}

    def is_proven(self, hand: Hand) -> bool:
        """Whether the moves can be done one after another: the arm reaches each pick and place, and the hand has room.

        A thing may be moved more than once.
        """
        now = self.start
        for goal in self.moves:
            begin = now.pop(goal.name)
            others = (*self.tray.walls, *now.values())
            if not all(is_within_reach(box) and hand.is_free(box, others) for box in (begin, goal)):
                return False
            now[goal.name] = goal
        return True

    def is_a_puzzle(self, hand: Hand) -> bool:
        """Whether the order of actions matters: some box cannot be taken at first, or put down at last."""
        return bool(self.blocked_picks(hand) or self.blocked_places(hand))

    def blocked_picks(self, hand: Hand) -> tuple[str, ...]:
        """The boxes that the hand cannot take at the start, as others are in its way."""
        return self._in_the_way(self.start, hand)

    def blocked_places(self, hand: Hand) -> tuple[str, ...]:
        """The boxes that fit where they go when all else is there, and that the hand cannot put down then."""
        return self._in_the_way({**self.start, **{goal.name: goal for goal in self.moves}}, hand)

    def _in_the_way(self, standing: Mapping[str, Standing], hand: Hand) -> tuple[str, ...]:
        """The boxes around which there is no room for the hand."""
        others = {box.name: [other for name, other in standing.items() if name != box.name] for box in self.boxes}
        return tuple(name for name, there in others.items() if hand.in_the_way(standing[name], there))

    @property
    def instance(self) -> BoxpackInstance:
        """The problem, and nothing of its solution: boxes and things stand in it by name."""
        (x, y), (dx, dy) = self.tray.center, self.tray.size
        basket = BasketSpec((_metres(x), _metres(y)), (_metres(dx), _metres(dy)), _metres(self.tray.rim))
        boxes = tuple(BoxSpec(*_spec(box)) for box in sorted(self.boxes, key=_name))
        return BoxpackInstance(
            basket, boxes, tuple(ClutterSpec(*_spec(thing)) for thing in sorted(self.clutter, key=_name))
        )

    @property
    def solution(self) -> tuple[Action, ...]:
        """Actions that carry out the moves."""
        return tuple(self._actions())

    def _actions(self) -> Iterator[Action]:
        start = self.start
        for goal in self.moves:
            turned = goal.is_along_y != start[goal.name].is_along_y
            params = {"x": _metres(goal.x), "y": _metres(goal.y), "theta": QUARTER_TURN if turned else 0.0}
            yield Action(PICK.name, (goal.name,))
            yield Action(PLACE.name, (goal.name,), params)


def _name(box: Standing) -> str:
    return box.name


def _spec(box: Standing) -> tuple[str, tuple[float, float, float], tuple[float, float]]:
    return box.name, (_metres(box.dx), _metres(box.dy), _metres(box.height)), (_metres(box.x), _metres(box.y))


def _metres(millimetres: float) -> float:
    return round(millimetres / 1000, 4)
