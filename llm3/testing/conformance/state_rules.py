"""Rules for states, the goal and the joints."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.interfaces import Joint
from llm3.jsonio import dumps, loads
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import programmer_talk
from llm3.testing.conformance.world import World
from llm3.types import GoalStatus, State


def _states(world: World) -> list[State]:
    """The initial state, and those that actions led to."""
    after = [trial.transition.state for trial in world.applied if trial.transition]
    return [world.start, *(state for state in after if isinstance(state, State))]


def reset_answers_a_state(world: World) -> Iterator[Fault]:
    """The answer of reset is a State, always the same."""
    again = world.env.reset()
    if not isinstance(world.start, State):
        yield Fault(f"reset must answer a State, not {world.start!r}.", "What reset sets up is what it answers.")
    elif again != world.start:
        yield Fault(
            f"reset answers {dumps(world.start)} and then {dumps(again)}.",
            "The initial state comes from the instance, and not from chance or from what was called before.",
        )


def states_survive_a_file(world: World) -> Iterator[Fault]:
    """A state that is written as JSON and read again is equal."""
    for state in _states(world):
        if loads(dumps(state), State, "the state") != state:
            yield Fault(
                f"a state is not equal to what is read of it: {dumps(state)}.",
                "A fact's value is a bool, a number or a text of plain Python.",
            )


def states_are_alike(world: World) -> Iterator[Fault]:
    """All states have as many joint values as the first, and a fact keeps its type."""
    types: dict[str, type] = {}
    for state in _states(world):
        if len(state.configuration) != len(world.start.configuration):
            yield Fault(
                f"a state has {len(state.configuration)} joint values, and the first one "
                f"{len(world.start.configuration)}.",
                "apply answers a whole State, with the robot's configuration at the end of the motion.",
            )
        for name, value in state.facts.items():
            if types.setdefault(name, type(value)) is not type(value):
                yield Fault(
                    f"fact {name!r} is a {types[name].__name__} and then a {type(value).__name__}.",
                    "True, 1 and 1.0 are equal in Python, but not in a record: keep to one type a name.",
                )


def joints_fit_the_configuration(world: World) -> Iterator[Fault]:
    """The joints, if they are told, are as many as the joint values, and have different names."""
    joints = world.env.joints
    if not isinstance(joints, tuple) or not all(isinstance(joint, Joint) for joint in joints):
        yield Fault(f"joints must be a tuple of Joint, not {joints!r}.", "A tuple of one needs a comma.")
        return
    values = len(world.start.configuration)
    if joints and len(joints) != values:
        yield Fault(
            f"there are {len(joints)} joints, and a configuration has {values} values.",
            "Joints stand in the order of State.configuration, one for each value: the gripper's are not among them.",
        )
    if len({joint.name for joint in joints}) < len(joints):
        yield Fault(f"two joints have one name: {', '.join(j.name for j in joints)}.", "Controllers go by the names.")


def the_goal_says_what_is_missing(world: World) -> Iterator[Fault]:
    """The answer of goal is a GoalStatus, always the same, whose unmet parts are different sentences for a model."""
    for state in _states(world):
        status, again = world.env.goal(state), world.env.goal(state)
        if not isinstance(status, GoalStatus):
            yield Fault(f"goal must answer a GoalStatus, not {status!r}.", "A bare truth value tells no model why.")
            return
        if status != again:
            yield Fault(
                f"goal of one state answers {status} and then {again}.", "goal must look at nothing but its state."
            )
        if status.achieved == bool(status.unmet):
            yield Fault(
                f"the goal is {'reached' if status.achieved else 'not reached'}, and what is unmet is {status.unmet}.",
                "A goal is reached exactly if nothing of it is unmet.",
            )
        for sentence in status.unmet:
            if not sentence.strip() or programmer_talk(sentence):
                yield Fault(f"a part of the goal is told as {sentence!r}.", "It is a sentence that a model reads.")
        if len(set(status.unmet)) < len(status.unmet):
            yield Fault(
                f"the same part of the goal is unmet twice: {status.unmet}.",
                "Name the object in the sentence: a model cannot tell the two apart.",
            )


def there_is_something_to_do(world: World) -> Iterator[Fault]:
    """The goal is not reached in the initial state."""
    if world.env.goal(world.start).achieved:
        yield Fault(
            "the goal is reached before anything is done.",
            "The generator of instances should draw again, or goal looks at the wrong thing.",
        )


RULES = (
    reset_answers_a_state,
    states_survive_a_file,
    states_are_alike,
    joints_fit_the_configuration,
    the_goal_says_what_is_missing,
    there_is_something_to_do,
)
