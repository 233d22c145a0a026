"""The second opinion on the states of a plan: they have to say what happened."""

from __future__ import annotations

from dataclasses import replace

import pytest
from shelf_world import (
    CARRIED,
    DROP,
    DROPPED,
    GRASP,
    SHELF,
    START,
    TAKE,
    TAKEN,
    at,
    box_at,
    found,
    lines,
)

from llm3.types import Held, Pose, State
from llm3_bullet.scene import Box


@pytest.fixture(scope="module")
def robot(descriptions):
    return descriptions["toy"]


@pytest.mark.parametrize(
    ("state", "sentences"),
    [
        (
            replace(DROP.state, configuration=at(0.11)),
            ["the motion ends with slide at 0.1000 m, and the state after it says 0.1100 m"],
        ),
        (replace(DROP.state, poses={"box": box_at(CARRIED + 0.0049)}), []),
        (
            replace(DROP.state, poses={"box": box_at(CARRIED + 0.006)}),
            ["box is 6.00 mm from where the state after it says"],
        ),
        (
            replace(DROP.state, poses={"box": box_at(CARRIED, 0.003)}),
            ["box rests on nothing: the next thing is 3.00 mm away"],
        ),
        (
            replace(DROP.state, poses={"box": box_at(CARRIED, -0.003)}),
            ["box rests 3.00 mm deep in shelf"],
        ),
        (
            replace(DROP.state, poses={"box": box_at(CARRIED, 1.0)}),
            [
                "box is 1000.00 mm from where the state after it says",
                "box rests on nothing: the next thing is at least 50.00 mm away",
            ],
        ),
        (replace(DROP.state, poses={}), ["the state after it does not say where box is"]),
        (
            replace(DROP.state, poses={**DROP.state.poses, "bax": box_at(0.0)}),
            ["the state after it says where 'bax' is, and there is no such thing"],
        ),
        (
            replace(DROP.state, held=Held("bax", GRASP)),
            ["the gripper holds nothing, and the state after it says bax"],
        ),
    ],
)
def test_a_state_that_says_something_else(robot, state, sentences):
    assert found(robot, replace(DROP, state=state)) == [f"{DROPPED}: {sentence}" for sentence in sentences]


def test_a_state_with_another_grasp(robot):
    step = replace(TAKE, state=replace(TAKE.state, held=Held("box", Pose((0.0, 0.0, 0.001)))))
    assert found(robot, step)[0] == f"{TAKEN}: box is held in another pose than the state after it says"


def test_a_box_that_moves_although_nothing_is_let_go(robot):
    other = box_at(0.3)
    start = replace(START, poses={**START.poses, "other": other})
    first = replace(TAKE, state=replace(TAKE.state, poses={"other": box_at(0.302)}))
    second = replace(DROP, state=replace(DROP.state, poses={**DROP.state.poses, "other": box_at(0.302)}))
    assert lines(robot, (first, second), start) == [
        f"{TAKEN}: other is 2.00 mm from where the state after it says",
    ]


def test_boxes_that_start_in_one_another_are_told_once(robot):
    start = State({"box": box_at(0.3), "other": box_at(0.33)}, at(0.0))
    assert lines(robot, (), start) == ["box rests 10.00 mm deep in other"]


BOARD = (0.314, 0.02, 0.008)
"""Half as long as the shelf."""
CANNOT = f"{DROPPED}: box cannot rest there: its centre"


def dropped_with(robot, end, *more):
    """What is told if the shelf ends at this x already, in metres; the box is let go at 0.03 and is 0.04 wide."""
    board = Box("shelf", BOARD, Pose((end - BOARD[0] / 2, *SHELF.pose.position[1:])), fixed=True)
    return lines(robot, fixed=(board, *more))


@pytest.mark.parametrize(("end", "sound"), [(0.05, True), (0.031, True), (0.02, False), (0.014, False)])
def test_a_box_that_reaches_over_an_edge_too_far(robot, end, sound):
    told = dropped_with(robot, end)
    if sound:
        assert told == []
    else:
        (line,) = told
        beside = float(line.removeprefix(f"{CANNOT} is ").removesuffix(" mm beside what it touches"))
        assert abs(beside - (0.03 - end) * 1000) < 5.0


def test_a_box_that_only_touches_something_beside_it(robot):
    post = Box("post", (0.02, 0.02, 0.04), Pose((0.0605, 0.1, 1.09)), fixed=True)
    assert dropped_with(robot, 0.005, post) == [f"{CANNOT} is 20.0 mm beside what it touches"]


def test_a_box_that_only_touches_something_above_it(robot):
    ceiling = Box("ceiling", (0.04, 0.02, 0.01), Pose((0.03, 0.1, 1.1155)), fixed=True)
    assert f"{CANNOT} is not over any of what it touches" in dropped_with(robot, 0.005, ceiling)
