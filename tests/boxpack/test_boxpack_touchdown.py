"""Touching down: which goals are offered, and what is said where there are none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from llm3.types import Contact, FailureKind
from llm3_bullet.scene import Scene
from llm3_bullet.tabletop.tabletop import CLEARANCE
from llm3_bullet.touchdown import Touchdown, TouchdownSettings
from llm3_bullet.touchdown_planner import TouchdownPlanner


@dataclass
class View:
    """Verdicts that were made up."""

    free: bool
    found: tuple[Contact, ...]
    checks: int = 0

    def valid(self, samples, clearance):
        return np.full(len(samples), self.free)

    def contacts(self, q, clearance):
        return self.found


@dataclass
class Checker:
    """Answers for each opening of the gripper, by which the tests tell scenes apart."""

    views: dict[float, View]

    def view(self, scene: Scene) -> View:
        return self.views[scene.opening]


FREE = View(True, ())


def touchdown(x: float, y: float = 0.0, opening: float = 0.08) -> Touchdown:
    tool = np.diag([1.0, -1.0, -1.0, 1.0])
    tool[:3, 3] = x, y, 0.05
    scene = Scene((), None, opening)
    return Touchdown(tool, scene, scene, scene, (), ())


@pytest.fixture
def goals(workcell):
    def ask(*options: Touchdown, views: dict[float, View] | None = None, enough: int = 3):
        checker = Checker(views or {0.08: FREE})
        planner = TouchdownPlanner(workcell.kinematics, workcell.inverse, checker, TouchdownSettings(enough=enough))
        return planner.goals(options, np.array(workcell.model.home), CLEARANCE, np.random.default_rng(0))

    return ask


def test_a_few_goals_are_offered_the_preferred_option_first(goals, workcell):
    found = goals(touchdown(0.5), touchdown(0.6))
    assert len(found) == 3
    assert found.stats.ik_calls == 1
    tools = workcell.kinematics.tool(np.array([goal.then[-1].waypoints[0] for goal in found]))
    assert tools[:, :3, 3] == pytest.approx(np.tile((0.5, 0.0, 0.05), (len(found), 1)), abs=0.001)


def test_more_goals_come_from_the_next_option(goals):
    found = goals(touchdown(0.5), touchdown(0.6), enough=200)
    assert len({goal.configuration for goal in found}) == len(found)
    assert found.stats.ik_calls == 2


def test_a_goal_is_made_when_it_is_looked_at(goals):
    found = goals(touchdown(0.5), touchdown(0.6), enough=200)
    assert found[1] is found[1]
    assert found.stats.ik_calls == 1
    assert len(found) > 3
    assert found.stats.ik_calls == 2


def test_goals_near_the_start_come_first_within_an_option(goals, workcell):
    found = goals(touchdown(0.5), enough=200)
    bottoms = np.array([goal.then[-1].waypoints[0] for goal in found])
    distances = np.linalg.norm(bottoms - workcell.model.home, axis=1)
    assert distances[0] == pytest.approx(distances.min(), abs=0.01)


def test_an_option_out_of_reach_does_not_hide_another(goals):
    assert len(goals(touchdown(1.2), touchdown(0.5))) > 0


def test_of_all_options_out_of_reach_the_nearest_miss_is_measured(goals):
    near, far = (goals(touchdown(x)) for x in (1.1, 1.4))
    both = goals(touchdown(1.4), touchdown(1.1))
    assert both.kind is FailureKind.UNREACHABLE
    assert near.measures["position_error"] < far.measures["position_error"]
    assert both.measures["position_error"] == pytest.approx(near.measures["position_error"], abs=0.02)


def test_the_contacts_of_the_option_that_is_least_in_the_way_are_told_the_deepest_first(goals):
    two = (Contact("arm", "red_box", 0.02), Contact("gripper", "tan_box", 0.001))
    one = (Contact("gripper", "blue_box", 0.03),)
    views = {0.01: View(False, two), 0.02: View(False, one)}
    failure = goals(touchdown(0.5, opening=0.01), touchdown(0.5, opening=0.02), views=views)
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert failure.contacts == one
    assert failure.objects == ("blue_box",)


def test_a_straight_piece_that_only_a_joint_limit_forbids_is_no_goal_and_no_collision(goals):
    failure = goals(touchdown(0.5, opening=0.03), views={0.03: View(False, ())})
    assert failure.kind is FailureKind.UNREACHABLE
    assert failure.contacts == ()
