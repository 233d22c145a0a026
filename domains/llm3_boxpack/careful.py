"""The stand-in where the prompt tells how high the hand is: geometry in place of experience.

It reckons with the numbers of the prompt, and with the gaps for which the families' problems are made, which a prompt
does not tell: what is in the way goes aside, and boxes are packed by chance, again and again, each where it and the
hand have room. So hardly any of its actions fail; but trays as full as those of the families are seldom filled by
chance. What finds no room is left out, and the next reply tries anew.
"""

from __future__ import annotations

import json

import numpy as np

from llm3.types import Context
from llm3_boxpack.families.draft import Draft
from llm3_boxpack.families.insertion import packed
from llm3_boxpack.families.shapes import from_low_to_tall
from llm3_boxpack.families.standing import Standing
from llm3_boxpack.families.starts import spread
from llm3_boxpack.view import View, view_of

TRIES = 10
"""How many packings are tried for a reply."""

Moves = tuple[Standing, ...]
"""Where things go, one after another."""


def careful_reply(context: Context, rng: np.random.Generator) -> str:
    """A reply in the format that the prompt asks for."""
    view = view_of(context)
    best: Moves = ()
    missing = len(view.boxes)
    for _ in range(TRIES):
        moves, left = _moves(view, rng)
        if left < missing or not best:
            best, missing = moves, left
        if not missing:
            break
    reasoning = "Low boxes go first, and each has room for the fingers and the palm when its turn comes."
    reasoning += f" I see no room for {missing} of the boxes yet." if missing else ""
    plan = Draft(view.tray, view.boxes, best, view.things).solution
    return json.dumps({"Reasoning": reasoning, "Full Plan": [str(action) for action in plan]})


def _moves(view: View, rng: np.random.Generator) -> tuple[Moves, int]:
    """Where everything goes in a packing by chance, and how many boxes are left out."""
    goals = {box.name: box for box in packed(from_low_to_tall(view.boxes, rng), view.tray, view.hand, rng, view.packed)}
    obstacles = (*view.tray.walls, *view.packed, *goals.values())
    aside = spread(view.things, (*obstacles, *view.things), view.hand, rng, keep_free=view.boxes) or ()
    goals = {**{thing.name: thing for thing in aside}, **goals}
    now = {thing.name: thing for thing in (*view.boxes, *view.packed, *view.things)}
    moves: list[Standing] = []
    while ready := next((name for name in goals if _is_ready(name, goals, now, view)), None):
        now[ready] = goals.pop(ready)
        moves.append(now[ready])
    done = {move.name for move in moves}
    return tuple(moves), sum(box.name not in done for box in view.boxes)


def _is_ready(name: str, goals: dict[str, Standing], now: dict[str, Standing], view: View) -> bool:
    """Whether something can be taken and put down where it belongs, as all else stands now."""
    others = (*view.tray.walls, *(thing for other, thing in now.items() if other != name))
    return view.hand.is_free(now[name], others) and view.hand.is_free(goals[name], others)
