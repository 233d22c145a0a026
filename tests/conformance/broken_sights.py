"""Yards that show something else than what is there."""

from __future__ import annotations

import numpy as np
from planted import Planted
from yard import a_yard

from llm3.interfaces import Scenery, Stage
from llm3.types import Body, box_surface

CUP = Body("cup", (box_surface((0.1, 0.1, 0.1)),))


class YardScenery(Scenery):
    bodies = (CUP, Body("robot", (box_surface((0.2, 0.2, 0.2)),), "robot"))

    def places(self, moment):
        robot = self.frame((*moment.configuration, 0.0))
        cup = self.frame(moment.poses["cup"].position) if "cup" in moment.poses else robot
        return {"cup": cup, "robot": robot}

    def frame(self, position):
        frame = np.eye(4)
        frame[:3, 3] = position
        return frame


class YardStage(Stage):
    """Red where the robot is, in a picture of the yard."""

    def show(self, moment):
        self.x = min(1.0, moment.configuration[0] / 2)

    def picture(self, width, height):
        found = np.full((height, width, 3), 255, dtype=np.uint8)
        found[:, int(self.x * (width - 1))] = (255, 0, 0)
        return found


def seen(**parts):
    """A yard with a scenery that has other parts."""
    return a_yard(scenery=lambda self, instance, options: type("Seen", (YardScenery,), parts)())


def staged(**parts):
    """A yard with a stage that has other parts."""
    return a_yard(stage=lambda self, instance, options, window: type("Staged", (YardStage,), parts)())


def sound():
    """A yard with both."""
    return a_yard(
        scenery=lambda self, instance, options: YardScenery(), stage=lambda self, instance, options, window: YardStage()
    )


def without_what_is_held(self, moment):
    places = YardScenery.places(self, moment)
    return places if "cup" in moment.poses else {"robot": places["robot"]}


def scaled(self, position):
    frame = YardScenery.frame(self, position)
    frame[:3, :3] *= 1000
    return frame


def left_behind(self, moment):
    return YardScenery.places(self, moment) | {"cup": self.frame((0.5, 0.5, 0.0))}


def trail(self, moment):
    self.trail = [*getattr(self, "trail", ()), moment.configuration[0] / 2]
    self.x = min(1.0, max(self.trail))


WHERE = "the scenery shows where everything is"
ALIKE = "the stage shows one moment in one way"
FAULTS: dict[str, Planted] = {
    "scenery class": Planted(
        a_yard(scenery=lambda self, instance, options: YardScenery),
        WHERE,
        "scenery must answer a Scenery or None, not <class 'broken_sights.YardScenery'>.",
        "an instance",
    ),
    "one body alone": Planted(seen(bodies=CUP), WHERE, "bodies must be a tuple of Body, not Body(…).", "a comma"),
    "twin bodies": Planted(
        seen(bodies=(CUP, CUP)), WHERE, "the scenery has two bodies of one name: cup, cup.", "by the names"
    ),
    "no body for the cup": Planted(
        seen(bodies=YardScenery.bodies[1:], places=lambda self, moment: {}),
        WHERE,
        "the scenery has no body for cup.",
        "the name that the state has",
    ),
    "place of nothing": Planted(
        seen(bodies=(CUP,)), WHERE, "the scenery tells where robot is, which is none of its bodies.", "every body"
    ),
    "held and gone": Planted(
        seen(places=without_what_is_held),
        WHERE,
        "the scenery does not tell where cup is when it is held.",
        "in the tool's frame",
    ),
    "millimetres": Planted(seen(frame=scaled), WHERE, "the scenery's frame of cup is no pose.", "in metres"),
    "no matrix": Planted(
        seen(frame=lambda self, position: position), WHERE, "the scenery's frame of cup is no pose.", "4 by 4"
    ),
    "left behind": Planted(
        seen(places=left_behind),
        WHERE,
        "the scenery shows cup 0 mm from its start, and it is … mm off.",
        "read from the moment",
    ),
    "stage class": Planted(
        a_yard(stage=lambda self, instance, options, window: YardStage),
        ALIKE,
        "stage must answer a Stage or None, not <class 'broken_sights.YardStage'>.",
        "an instance",
    ),
    "lying picture": Planted(
        staged(picture=lambda self, width, height: np.zeros((width, height, 3), dtype=np.uint8)),
        ALIKE,
        "a picture of 64 by 48 pixels is an array (64, 48, 3) of uint8.",
        "(height, width, 3)",
    ),
    "picture of fractions": Planted(
        staged(picture=lambda self, width, height: np.zeros((height, width, 3))),
        ALIKE,
        "a picture of 64 by 48 pixels is an array (48, 64, 3) of float64.",
        "from 0 to 255",
    ),
    "trail": Planted(staged(show=trail), ALIKE, "the stage shows one state in two ways.", "showed before"),
}
