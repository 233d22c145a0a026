"""The nouns refuse what cannot be, in one sentence for whoever writes a plugin."""

import numpy as np
import pytest

from llm3.types import (
    Action,
    ActionSchema,
    Context,
    Entity,
    Failure,
    FailureKind,
    Goal,
    GoalStatus,
    Motion,
    MotionProblem,
    Parameter,
    Pose,
    Sketch,
    State,
    Transition,
)

NAN = float("nan")


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Parameter("x", 1, 0), "parameter 'x' has a range from 1 to 0, which is empty"),
        (lambda: Parameter("x", 0, float("inf")), "the range of parameter 'x' must be finite numbers, not (0.0, inf)"),
        (lambda: ActionSchema("pick up"), "an action's name must be letters, digits and underscores, not 'pick up'"),
        (
            lambda: ActionSchema("press", "button"),
            "the objects of action 'press' must be a tuple of texts, not 'button'; write ('button',)",
        ),
        (
            lambda: ActionSchema("go", (), (Parameter("x", 0, 1), Parameter("x", 0, 2))),
            "action 'go' has two parameters of one name: x, x",
        ),
        (lambda: Action("go", "box"), "the objects of 'go' must be a tuple of texts, not 'box'; write ('box',)"),
        (lambda: Sketch("go", (1,)), "the objects of 'go' must be a tuple of texts, and 1 is none"),
        (
            lambda: Failure(FailureKind.UNREACHABLE, objects="box"),
            "the objects of a failure must be a tuple of texts, not 'box'; write ('box',)",
        ),
        (
            lambda: GoalStatus(False, "not there"),
            "what is unmet of a goal must be a tuple of texts, not 'not there'; write ('not there',)",
        ),
        (
            lambda: Transition(State(), "slid"),
            "the notes of a transition must be a tuple of texts, not 'slid'; write ('slid',)",
        ),
        (
            lambda: Context("", (), "button", ()),
            "the objects of an Env must be a tuple of texts, not 'button'; write ('button',)",
        ),
        (lambda: State(configuration=(0.0, NAN)), "a configuration must be finite numbers, not (0.0, nan)"),
        (lambda: State(facts={"n": None}), "fact 'n' must be a bool, a number or a text, not None"),
        (lambda: Pose((0, 0, NAN)), "a position must be finite numbers, not (0.0, 0.0, nan)"),
        (
            lambda: Pose((0, 0, 0), (0, 0, 0, 0)),
            "an orientation is a unit quaternion x, y, z, w, not (0, 0, 0, 0)",
        ),
        (lambda: Goal((NAN,)), "a goal's configuration must be finite numbers, not (nan,)"),
        (
            lambda: MotionProblem((NAN,), (Goal((0,)),), 0, 1, lambda Q: Q, 0.1),
            "a start's configuration must be finite numbers, not (nan,)",
        ),
        (
            lambda: Entity("box", {"size": None}),
            "size of box must be a text, a number or a tuple of numbers, not None",
        ),
        (lambda: Motion().end, "this action has no motion: the robot stays in state.configuration"),
    ],
)
def test_what_cannot_be_is_refused_in_one_sentence(make, sentence):
    with pytest.raises((TypeError, ValueError)) as caught:
        make()
    assert str(caught.value) == sentence


def test_numpy_values_become_plain_ones():
    entity = Entity("box", {"size": np.array((0.1, 0.2)), "count": np.int64(3), "yaw": np.float64(0.5)})
    assert entity.properties == {"size": (0.1, 0.2), "count": 3, "yaw": 0.5}
    assert [type(value) for value in entity.properties.values()] == [tuple, int, float]
    assert type(State(facts={"open": np.bool_(True)}).facts["open"]) is bool


def test_the_order_in_which_a_state_is_made_does_not_show():
    one = State({"a": Pose((0, 0, 0)), "b": Pose((1, 0, 0))}, facts={"x": 1, "y": 2})
    two = State({"b": Pose((1, 0, 0)), "a": Pose((0, 0, 0))}, facts={"y": 2, "x": 1})
    assert list(one.poses) == list(two.poses)
    assert list(one.facts) == list(two.facts)
