"""One plan after another in one world: what is tried, what is remembered, and what is counted."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from line_world import PLANNED, PREPARED, Detour, Gamble, Line, TickingClock, go, take

from llm3.rollout import Roller
from llm3.types import Action, Failure, FailureKind, Motion, Rejected, State, Stats

GOAL = FailureKind.GOAL_IN_COLLISION
START = FailureKind.START_IN_COLLISION
UNREACHABLE = FailureKind.UNREACHABLE
NO_PATH = FailureKind.NO_PATH
PRECONDITION = FailureKind.PRECONDITION
NONSENSE = Rejected("dance()", Failure(FailureKind.INVALID_ACTION, "unknown action 'dance'"))


def roller(env=None, planner=None, seed=0, clock=lambda: 0.0):
    return Roller(env or Line(), planner or Detour(), seed, clock)


def roll(roller, *actions):
    return roller.rollout(Line().reset(), actions)


def kinds(rolled):
    """What became of each action that was reached."""
    return [outcome.failure and outcome.failure.kind for outcome in rolled.outcomes]


def reused(rolled):
    return [outcome.reused for outcome in rolled.outcomes]


def counts(roller):
    return roller.stats.motion_calls, roller.stats.reused_actions


# ---- one plan ------------------------------------------------------------------------------------------------------


def test_every_feasible_action_moves_the_state_on():
    rolled = roll(roller(), go(1), take("coin"), go(3))
    assert kinds(rolled) == [None, None, None]
    assert [step.action for step in rolled.plan] == [go(1), take("coin"), go(3)]
    assert [step.state.configuration for step in rolled.plan] == [(1.0,), (1.0,), (3.0,)]
    assert rolled.state == rolled.plan[-1].state == State(configuration=(3.0,), facts={"coin": True})


def test_motions_join_up_and_an_action_without_motion_has_an_empty_one():
    rolled = roll(roller(), go(1), take("coin"), go(3))
    first, second, third = (step.motion for step in rolled.plan)
    assert first.segments[0].waypoints[0] == (0.0,)
    assert first.end == third.segments[0].waypoints[0] == (1.0,)
    assert second == Motion()
    assert [outcome.moved for outcome in rolled.outcomes] == [True, False, True]


@pytest.mark.parametrize(
    ("trouble", "refuses", "count"),
    [
        ({2: GOAL}, {}, 2),
        ({2: UNREACHABLE}, {}, 2),
        ({2: START}, {}, 2),
        ({2: NO_PATH}, {}, 2),
        ({2: PRECONDITION}, {}, 1),
        ({}, {2: GOAL}, 2),
        ({}, {2: START}, 2),
        ({}, {2: NO_PATH}, 2),
    ],
)
def test_a_failure_ends_the_plan_and_counts_if_motion_was_evaluated(trouble, refuses, count):
    one = roller(Line(trouble), Detour(refuses=refuses))
    rolled = roll(one, go(1), go(2), go(3))
    assert kinds(rolled) == [None, (trouble or refuses)[2]]
    assert rolled.state.configuration == (1.0,)
    assert len(rolled.plan) == 1
    assert counts(one) == (count, 0)


def test_an_invalid_action_fails_when_it_is_reached_and_counts_nothing():
    one = roller()
    rolled = roll(one, go(1), go(2), NONSENSE, go(3))
    assert kinds(rolled) == [None, None, FailureKind.INVALID_ACTION]
    assert rolled.outcomes[-1].action is NONSENSE
    assert rolled.outcomes[-1].failure is NONSENSE.failure
    assert rolled.state.configuration == (2.0,)
    assert counts(one) == (2, 0)


def test_an_action_without_motion_and_an_impossible_one_count_nothing():
    one = roller()
    assert kinds(roll(one, take("coin"))) == [PRECONDITION]
    assert counts(one) == (0, 0)
    assert kinds(roll(one, go(1), take("coin"))) == [None, None]
    assert counts(one) == (1, 0)


def test_an_empty_plan_goes_nowhere():
    one = roller()
    rolled = roll(one)
    assert (rolled.outcomes, rolled.plan, rolled.state) == ((), (), Line().reset())
    assert one.stats == Stats()


def test_what_physics_did_against_the_plan_is_noted_and_is_where_the_next_action_begins():
    rolled = roll(roller(Line(slippery={2.0: 0.5})), go(2), go(3))
    assert rolled.outcomes[0].notes == ("the robot slid 0.5 m",)
    assert rolled.plan[0].state.configuration == (2.5,)
    assert rolled.plan[1].motion.segments[0].waypoints[0] == (2.5,)


def test_everything_is_told_as_it_happens():
    seen = []
    env = Line({2: GOAL})
    observe = lambda *told: seen.append((*told, len(env.asked)))  # noqa: E731  # reads as a value
    rolled = roller(env).rollout(env.reset(), [go(1), go(2), go(3)], observe)
    (step,) = rolled.plan
    assert seen == [(0, env.reset(), rolled.outcomes[0], step, 1), (1, step.state, rolled.outcomes[1], None, 2)]


# ---- what is remembered --------------------------------------------------------------------------------------------


def test_a_feasible_prefix_is_reused():
    env = Line()
    one = roller(env)
    first, second = roll(one, go(1), go(2), go(3)), roll(one, go(1), go(2), go(4))
    assert reused(second) == [True, True, False]
    assert second.plan[:2] == first.plan[:2]
    assert counts(one) == (4, 2)
    assert len(env.asked) == 4


@pytest.mark.parametrize("kind", [GOAL, START, UNREACHABLE, PRECONDITION])
def test_a_failure_that_no_seed_would_change_is_reused(kind):
    env = Line({2: kind})
    one = roller(env)
    first, second = roll(one, go(2)), roll(one, go(2))
    assert second.outcomes[0].failure == first.outcomes[0].failure
    assert reused(first) + reused(second) == [False, True]
    assert counts(one) == (int(kind.is_motion), 1)
    assert len(env.asked) == 1


@pytest.mark.parametrize("kind", [GOAL, START])
def test_so_is_such_a_failure_of_the_planner(kind):
    one = roller(planner=Detour(refuses={2: kind}))
    assert kinds(roll(one, go(2))) == kinds(roll(one, go(2))) == [kind]
    assert counts(one) == (1, 1)


def test_no_path_is_tried_again_with_another_seed_and_counted_again():
    env = Line()
    one = roller(env, Detour(no_path={2: 2}))
    tries = [roll(one, go(2)) for _ in range(4)]
    assert [kinds(t) for t in tries] == [[NO_PATH], [NO_PATH], [None], [None]]
    assert [reused(t) for t in tries] == [[False], [False], [False], [True]]
    assert counts(one) == (3, 1)
    assert len({draw for _, _, draw in env.asked}) == 3


def test_so_a_planner_that_found_no_path_may_find_one_the_next_time():
    one = roller(planner=Gamble())
    tries = [[kinds(roll(one, go(x))) for _ in range(30)] for x in range(1, 9)]
    assert any(of_one[0] == [NO_PATH] for of_one in tries)
    assert all(of_one[-1] == [None] for of_one in tries)


def test_no_path_of_the_world_itself_is_tried_again_too():
    env = Line({2: NO_PATH})
    one = roller(env)
    assert kinds(roll(one, go(2))) == kinds(roll(one, go(2))) == [NO_PATH]
    assert counts(one) == (2, 0)
    assert len({draw for _, _, draw in env.asked}) == 2


def test_an_invalid_action_is_never_reused():
    one = roller()
    assert reused(roll(one, NONSENSE)) + reused(roll(one, NONSENSE)) == [False, False]
    assert counts(one) == (0, 0)


def test_the_same_action_in_another_state_is_another_question():
    one = roller()
    roll(one, go(1), go(3))
    assert reused(roll(one, go(2), go(3))) == [False, False]
    assert counts(one) == (4, 0)


def test_the_same_state_by_another_way_is_the_same_question():
    one = roller()
    roll(one, go(1), go(2), go(3))
    assert reused(roll(one, go(2), go(3))) == [False, True]


def test_a_state_that_comes_again_within_one_plan_is_known():
    one = roller()
    assert reused(roll(one, go(1), go(2), go(1), go(2))) == [False, False, False, True]
    assert counts(one) == (3, 1)


def test_notes_are_told_again_with_a_known_result():
    one = roller(Line(slippery={2.0: 0.5}))
    assert roll(one, go(2)).outcomes[0].notes == roll(one, go(2)).outcomes[0].notes == ("the robot slid 0.5 m",)


def test_two_rollers_know_nothing_of_each_other():
    env = Line()
    roll(roller(env), go(1))
    assert reused(roll(roller(env), go(1))) == [False]


# ---- what is counted -----------------------------------------------------------------------------------------------


def test_what_the_world_and_the_planner_spent_is_added_up():
    one = roller(Line({3: UNREACHABLE}), Detour(no_path={2: 1}))
    roll(one, go(1), take("coin"), go(2))  # two queries; the second finds no path
    roll(one, go(1), take("coin"), go(2), go(3))  # two known results, one query, and one refusal without a query
    spent = sum([PREPARED] * 5 + [PLANNED] * 3, Stats())
    assert one.stats == spent + Stats(motion_calls=4, reused_actions=2, seconds=one.stats.seconds)


def test_seconds_are_told_by_phase():
    one = roller(Line({3: UNREACHABLE}), Detour(refuses={4: START}), clock=TickingClock())
    roll(one, go(1), take("coin"), go(3))
    roll(one, go(1), go(4))
    assert one.stats.seconds == {"prepare": 4.0, "plan": 2.0, "apply": 2.0}


PLANS = st.lists(st.sampled_from([go(1), go(2), go(3), take("coin"), NONSENSE]), max_size=4)


@given(st.lists(PLANS, max_size=5))
def test_every_action_that_was_reached_is_counted_once_or_known_or_no_matter_of_motion(plans):
    one = roller(Line({3: GOAL}), Detour(no_path={2: 2}))
    outcomes = [outcome for plan in plans for outcome in roll(one, *plan).outcomes]
    motion = [o for o in outcomes if isinstance(o.action, Action) and o.action.name == "go" and not o.reused]
    assert counts(one) == (len(motion), sum(outcome.reused for outcome in outcomes))


# ---- what randomness depends on ------------------------------------------------------------------------------------


def paths(plans, planner, seed=0):
    """Every motion and every draw of the world, by what was asked: state, action and number of the try."""
    env = Line()
    one = roller(env, planner, seed)
    motions = {}
    for plan in plans:
        state = env.reset()
        for step in roll(one, *plan).plan:
            motions[state, step.action] = step.motion
            state = step.state
    draws, tries = {}, {}
    for state, action, draw in env.asked:
        tries[state, action] = tries.get((state, action), 0) + 1
        draws[state, action, tries[state, action]] = draw
    return motions, draws


MOVES = st.lists(st.lists(st.sampled_from([go(1), go(2), go(3), go(4)]), max_size=4), max_size=5)


@given(MOVES, st.randoms(), st.integers(0, 3))
def test_the_same_plans_in_another_order_give_the_same_paths(plans, random, seed):
    shuffled = plans[:]
    random.shuffle(shuffled)
    assert paths(shuffled, Detour(), seed) == paths(plans, Detour(), seed)


@given(MOVES, MOVES, st.integers(0, 3))
def test_whatever_was_asked_before_the_same_try_has_the_same_generator(plans, before, seed):
    motions, draws = paths(plans, Gamble(), seed)
    other_motions, other_draws = paths(before + plans, Gamble(), seed)
    assert all(other_draws[asked] == draws[asked] for asked in set(draws) & set(other_draws))
    assert all(other_motions[asked] == motions[asked] for asked in set(motions) & set(other_motions))


def test_every_state_action_and_run_seed_has_a_generator_of_its_own():
    plans = [[go(1), go(2)], [go(2)], [go(3), go(2)]]
    motions, draws = paths(plans, Detour(), seed=0)
    other_motions, other_draws = paths(plans, Detour(), seed=1)
    assert len({*draws.values(), *other_draws.values()}) == 2 * 5
    between = [motion.segments[0].waypoints[1] for motion in (*motions.values(), *other_motions.values())]
    assert len(set(between)) == 2 * 5
