"""The whole loop, as the paper's Algorithm 1 has it."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from line_world import (
    FINISH,
    PLANNED,
    PREPARED,
    SAMPLE_PARAMS,
    Detour,
    Line,
    Mute,
    Plain,
    TickingClock,
    go,
    play,
    reply,
    take,
)

from llm3 import Budget, LLMBackend
from llm3.errors import BackendError, PluginError, UsageError
from llm3.parsing import reply_schema
from llm3.testing import ScriptedLLM
from llm3.types import (
    ActionTried,
    AttemptEnded,
    CallFailed,
    Completion,
    FailureKind,
    PromptSent,
    ReplyRead,
    ReplyReceived,
    RunEnded,
    RunStarted,
    Sketch,
    Stats,
)

GOAL = FailureKind.GOAL_IN_COLLISION
UNREACHABLE = FailureKind.UNREACHABLE
UNREADABLE = FailureKind.UNREADABLE_REPLY
ARRIVE = reply(go(FINISH))
MUMBLE = "I would rather not."


def counts(result):
    """#LM, #MP, reused."""
    return result.stats.llm_calls, result.stats.motion_calls, result.stats.reused_actions


def failures(result):
    return [attempt.failure and attempt.failure.kind for attempt in result.attempts]


def plan(result):
    return [step.action for step in result.plan]


# ---- how a run ends ------------------------------------------------------------------------------------------------


def test_a_plan_that_reaches_the_goal_solves_the_run():
    result = play(reply(go(1), take("coin"), go(FINISH)))
    assert result.solved
    assert result.goal.achieved
    assert plan(result) == [go(1), take("coin"), go(FINISH)]
    assert result.start == Line().reset()
    assert counts(result) == (1, 2, 0)
    assert not result.time_limited


def test_a_feasible_plan_that_does_not_reach_the_goal_does_not():
    result = play(reply(go(1), go(2)))
    assert not result.solved
    assert result.plan == ()
    assert result.goal.unmet == ("the robot is not at the finish",)
    assert failures(result) == [None]


def test_a_plan_reaches_the_goal_with_the_actions_before_one_that_fails():
    result = play(reply(go(FINISH), go(5), go(1)), env=Line({5: GOAL}))
    assert result.solved
    assert plan(result) == [go(FINISH)]
    assert failures(result) == [GOAL]


def test_so_does_one_with_an_invalid_action_behind_the_goal():
    result = play(reply(go(FINISH), "dance()"))
    assert result.solved
    assert plan(result) == [go(FINISH)]
    assert counts(result) == (1, 1, 0)


def test_a_plan_that_leaves_the_goal_again_does_not():
    assert not play(reply(go(FINISH), go(1))).solved


def test_every_plan_starts_from_the_initial_state():
    result = play(reply(go(1)), reply(take("coin")), ARRIVE)
    assert failures(result) == [None, FailureKind.PRECONDITION, None]
    assert plan(result) == [go(FINISH)]
    assert result.plan[0].motion.segments[0].waypoints[0] == (0.0,)


def test_an_empty_plan_is_an_attempt_that_goes_nowhere():
    result = play(reply(), ARRIVE)
    assert result.attempts[0].outcomes == ()
    assert result.attempts[0].failure is None
    assert not result.attempts[0].goal.achieved
    assert counts(result) == (2, 1, 0)


def test_where_the_goal_is_true_at_the_start_no_model_is_asked():
    result = play(ARRIVE, env=Line(start=FINISH))
    assert (result.solved, result.goal.achieved, result.stop) == (True, True, "solved")
    assert (result.plan, result.attempts, result.stats.llm_calls) == ((), (), 0)


def test_the_budget_ends_a_run():
    model = ScriptedLLM(lambda request: reply(go(1)))
    result = play(backend=model, budget=Budget(max_llm_calls=4))
    assert not result.solved
    assert len(model.requests) == len(result.attempts) == 4
    assert counts(result) == (4, 1, 3)


def test_the_budget_of_the_paper_is_the_default():
    assert Budget() == Budget(max_llm_calls=20, trace_size=5)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"max_llm_calls": 0}, "the number of model calls must be at least 1, not 0."),
        ({"trace_size": -1}, "the trace size must be 0 or more, not -1."),
        ({"max_tokens": 0}, "the number of tokens must be at least 1, not 0."),
        ({"max_seconds": 0.0}, "the seconds of a run must be more than 0, not 0."),
        ({"max_seconds": float("nan")}, "the seconds of a run must be more than 0, not nan."),
    ],
)
def test_a_budget_without_sense_is_refused(arguments, sentence):
    with pytest.raises(UsageError) as caught:
        Budget(**arguments)
    assert str(caught.value) == sentence


def test_a_run_says_why_it_ended():
    assert play(ARRIVE).stop == "solved"
    assert play(reply(go(1)), budget=Budget(max_llm_calls=1)).stop == "calls"


def test_no_call_is_made_once_the_tokens_are_used_up():
    spent = Stats(prompt_tokens=70, completion_tokens=30, reasoning_tokens=20, cached_tokens=60)
    model = ScriptedLLM(lambda request: Completion(reply(go(1)), spent))
    result = play(backend=model, budget=Budget(max_tokens=201))
    assert (result.stop, result.stats.tokens, result.stats.llm_calls) == ("tokens", 300, 3)
    assert play(backend=model, budget=Budget(max_tokens=200)).stats.llm_calls == 2


def test_no_call_is_made_once_the_time_is_used_up():
    """The clock ticks once for each look."""
    result = play(
        backend=ScriptedLLM(lambda request: reply(go(1))), budget=Budget(max_seconds=20), clock=TickingClock()
    )
    assert result.stop == "seconds"
    assert 1 < result.stats.llm_calls < 20


def test_a_call_may_take_what_is_left_of_the_time():
    model = ScriptedLLM(lambda request: reply(go(1)))
    play(backend=model, budget=Budget(max_seconds=20), clock=TickingClock())
    left = [request.seconds for request in model.requests]
    assert left == sorted(left, reverse=True)
    assert 0 < left[-1] < left[0] < 20
    play(backend=model, budget=Budget(max_llm_calls=1))
    assert model.requests[-1].seconds == float("inf")


def test_a_call_that_fails_for_lack_of_time_ends_the_run_by_its_budget():
    clock, events = TickingClock(), []

    def too_slow(request):
        for _ in range(20):
            clock()
        return BackendError("no answer in time.", retries=3, step_downs=1)

    result = play(backend=ScriptedLLM(too_slow), budget=Budget(max_seconds=20), clock=clock, observer=events.append)
    assert (result.stop, result.attempts) == ("seconds", ())
    assert (result.stats.llm_calls, result.stats.retries, result.stats.step_downs) == (0, 3, 1)
    (failed,) = (event for event in events if isinstance(event, CallFailed))
    assert (failed.attempt, failed.error, failed.stats.retries) == (1, "no answer in time.", 3)


def test_a_call_that_is_given_up_for_lack_of_time_ends_the_run_by_its_budget_too():
    model = ScriptedLLM([BackendError("the server is busy.", retries=1, out_of_time=True)])
    result = play(backend=model, budget=Budget(max_seconds=20))
    assert (result.stop, result.stats.retries) == ("seconds", 1)


def test_the_run_ends_with_the_first_plan_that_reaches_the_goal():
    model = ScriptedLLM([reply(go(1)), ARRIVE, ARRIVE])
    assert len(play(backend=model, budget=Budget(max_llm_calls=3)).attempts) == 2
    assert len(model.requests) == 2


def test_attempts_are_numbered_from_1():
    assert [attempt.number for attempt in play(MUMBLE, reply(), ARRIVE).attempts] == [1, 2, 3]


# ---- what is counted -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("script", "expected"),
    [
        ([reply(go(1), go(5)), reply(go(1), go(2)), reply(go(1), go(2), go(FINISH))], (3, 4, 3)),
        ([reply(go(5)), reply(go(5)), reply(go(6)), reply(go(6))], (4, 2, 2)),
        ([reply(go(3)), reply(go(3)), reply(go(3)), reply(go(3))], (4, 3, 1)),
        ([reply(take("coin")), reply(take("coin"))], (2, 0, 1)),
        ([reply(go(1), take("coin")), reply(go(1), take("coin"))], (2, 1, 2)),
        ([reply("dance()"), reply("go([], {'x': 11})"), reply(go(1), "dance()")], (3, 1, 0)),
        ([MUMBLE, reply(go(1)), MUMBLE, reply(go(1))], (4, 1, 1)),
        ([reply(), ""], (2, 0, 0)),
    ],
    ids=[
        "a feasible prefix is known",
        "a failure that stays is known",
        "no path is tried until one is found",
        "a precondition is no matter of motion",
        "an action without motion is not either",
        "nor is an invalid action",
        "an unreadable reply is a call",
        "and so is an empty one",
    ],
)
def test_calls_of_the_model_motions_and_known_results(script, expected):
    env, planner = Line({5: GOAL, 6: UNREACHABLE}), Detour(no_path={3: 2})
    assert counts(play(*script, env=env, planner=planner)) == expected


def test_unreadable_replies_are_counted_apart_too():
    result = play(MUMBLE, reply(go(1)), "", ARRIVE)
    assert failures(result) == [UNREADABLE, None, UNREADABLE, None]
    assert result.stats.unreadable_replies == 2
    assert result.stats.llm_calls == len(result.attempts) == 4


def test_an_unreadable_reply_is_an_attempt_with_no_actions():
    (attempt,) = play(MUMBLE).attempts
    assert attempt.proposal is None
    assert attempt.outcomes == ()
    assert attempt.failure is attempt.unreadable
    assert attempt.goal.unmet == ("the robot is not at the finish",)


def test_what_the_components_spent_is_added_up():
    answer = Completion(ARRIVE, Stats(prompt_tokens=10, completion_tokens=5, retries=1, step_downs=2))
    mumble = Completion(MUMBLE, Stats(prompt_tokens=7))
    stats = play(mumble, answer, clock=lambda: 0.0).stats
    seconds = dict.fromkeys(("model", "prepare", "plan", "apply"), 0.0)
    own = Stats(llm_calls=2, motion_calls=1, unreadable_replies=1, seconds=seconds)
    assert stats == own + PREPARED + PLANNED + mumble.stats + answer.stats


def test_seconds_are_told_by_phase():
    result = play(reply(go(1), go(5)), ARRIVE, env=Line({5: GOAL}), clock=TickingClock())
    assert result.stats.seconds == {"model": 2.0, "prepare": 3.0, "plan": 2.0, "apply": 2.0}


def test_a_run_that_a_clock_cut_off_says_so():
    assert play(ARRIVE, planner=Detour(stats=Stats(time_limited=1))).time_limited


# ---- what the model is told ----------------------------------------------------------------------------------------


def told(result_of, model):
    """The attempts that the last prompt tells of."""
    return [feedback.attempt for feedback in model.requests[-1].context.trace]


@pytest.mark.parametrize(
    ("size", "attempts"), [(0, []), (1, [5]), (2, [4, 5]), (5, [1, 2, 3, 4, 5]), (9, [1, 2, 3, 4, 5])]
)
def test_a_prompt_tells_of_the_last_k_attempts(size, attempts):
    model = ScriptedLLM([reply(go(x)) for x in (1, 2, 3, 4, 5)] + [ARRIVE])
    result = play(backend=model, budget=Budget(6, size))
    assert told(result, model) == attempts


@pytest.mark.parametrize(("size", "attempts"), [(0, []), (1, [1, 4]), (2, [1, 4]), (5, [1, 2, 3, 4])])
def test_an_unreadable_reply_does_not_push_the_newest_attempt_with_motions_out(size, attempts):
    model = ScriptedLLM([reply(go(1)), MUMBLE, MUMBLE, MUMBLE, ARRIVE])
    result = play(backend=model, budget=Budget(5, size))
    assert told(result, model) == attempts


def test_the_first_prompt_tells_of_nothing_and_the_next_of_what_failed_and_why():
    model = ScriptedLLM([reply(go(1), go(5)), MUMBLE, reply("dance()"), ARRIVE])
    play(backend=model, env=Line({5: GOAL}), budget=Budget(4))
    assert "You know of none." in model.prompts[0]
    assert "1. go([], {'x': 1.0}): feasible.\n2. go([], {'x': 5.0}): failed. goal in collision" in model.prompts[1]
    assert "the robot is not at the finish" in model.prompts[1]
    assert "no complete plan can be read from the reply" in model.prompts[2]
    assert "dance(): failed. invalid action" in model.prompts[3]


def test_notes_reach_the_model_from_feasible_and_from_known_actions():
    model = ScriptedLLM([reply(go(2)), reply(go(2)), ARRIVE])
    play(backend=model, env=Line(slippery={2.0: 0.5}), budget=Budget(3))
    assert "go([], {'x': 2.0}): feasible. the robot slid 0.5 m" in model.prompts[1]
    assert model.prompts[2].count("the robot slid 0.5 m") == 2


def test_a_level_that_says_nothing_leaves_every_prompt_as_the_first():
    model = ScriptedLLM([reply(go(1)), MUMBLE, ARRIVE])
    play(backend=model, feedback=Mute(), budget=Budget(3))
    assert len(set(model.prompts)) == 1


def test_feedback_is_asked_for_once_for_each_attempt_that_did_not_reach_the_goal():
    class Counting(Plain):
        seen = ()

        def synthesize(self, attempt):
            self.seen += (attempt.number,)
            return super().synthesize(attempt)

    words = Counting()
    play(reply(go(1)), MUMBLE, ARRIVE, feedback=words)
    assert words.seen == (1, 2)


def test_the_context_is_what_the_prompt_shows_and_the_initial_state_at_that():
    model = ScriptedLLM([reply(go(1)), ARRIVE])
    env = Line()
    play(backend=model, env=env, budget=Budget(2))
    for request in model.requests:
        context = request.context
        assert (context.task, context.actions, context.objects) == (env.task, env.schemas, env.objects)
        assert context.state == env.describe(env.reset())
        assert context.skeleton == ()


def test_a_given_sequence_is_shown_and_a_reply_that_changes_it_is_invalid():
    skeleton = (Sketch("go"), Sketch("take", ("coin",)), Sketch("go"))
    model = ScriptedLLM([reply(go(1), go(FINISH)), reply(go(1), take("coin"), go(FINISH))])
    result = play(backend=model, strategy=SAMPLE_PARAMS, skeleton=skeleton, budget=Budget(2))
    assert "1. go([], ...)\n2. take(['coin'], ...)\n3. go([], ...)" in model.prompts[0]
    assert failures(result) == [FailureKind.INVALID_ACTION, None]
    assert (
        result.attempts[0].failure.detail == "action 2 must be take(['coin'], ...), not go([], ...): "
        "the action sequence is given, choose the parameters only"
    )
    assert counts(result) == (2, 2, 1)


# ---- what an observer sees -----------------------------------------------------------------------------------------


def test_events_come_in_order():
    events = []
    result = play(reply(go(1), go(5)), MUMBLE, ARRIVE, env=Line({5: GOAL}), observer=events.append)
    begin, end = [PromptSent, ReplyReceived, ReplyRead], [AttemptEnded]
    assert [type(event) for event in events] == [
        RunStarted,
        *[*begin, ActionTried, ActionTried, *end],
        *[*begin, *end],
        *[*begin, ActionTried, *end],
        RunEnded,
    ]
    assert events[0].state == result.start
    assert events[-1].result is result
    assert [e.attempt for e in events if isinstance(e, PromptSent)] == [1, 2, 3]
    assert [(e.attempt, e.index) for e in events if isinstance(e, ActionTried)] == [(1, 0), (1, 1), (3, 0)]
    ended = [e for e in events if isinstance(e, AttemptEnded)]
    assert tuple(e.attempt for e in ended) == result.attempts
    assert [e.feedback is None for e in ended] == [False, False, True]
    assert ended[-1].stats == result.stats


def test_an_observer_hears_of_a_prompt_before_the_model_does():
    order = []
    model = ScriptedLLM(lambda request: order.append("asked") or ARRIVE)
    play(backend=model, observer=lambda event: order.append(type(event).__name__))
    assert order[:4] == ["RunStarted", "PromptSent", "asked", "ReplyReceived"]


# ---- what goes wrong with the program ------------------------------------------------------------------------------


def test_an_error_of_the_backend_passes_through_and_is_told():
    events = []
    with pytest.raises(BackendError) as caught:
        play(reply(go(1)), BackendError("no server answers.", retries=2), observer=events.append)
    assert str(caught.value) == "no server answers."
    assert isinstance(events[-1], CallFailed)
    assert (events[-1].attempt, events[-1].error, events[-1].stats.retries) == (2, "no server answers.", 2)


def test_a_reply_that_was_cut_off_is_told_apart_from_one_that_makes_no_sense():
    begun = '{"Reasoning": "First I'
    result = play(Completion(begun, finish_reason="length"), begun, budget=Budget(2))
    cut, senseless = (attempt.failure.detail for attempt in result.attempts)
    assert cut.startswith("the reply was cut off at the length limit before its plan was complete: ")
    assert senseless.startswith("no complete plan can be read from the reply: ")


def test_a_plan_that_is_complete_is_read_also_where_the_reply_was_cut_off():
    assert play(Completion(f"{ARRIVE} And now I", finish_reason="length")).solved


def test_a_request_holds_the_schema_of_the_reply():
    model = ScriptedLLM([ARRIVE])
    play(backend=model)
    assert model.requests[0].schema == reply_schema(Line().schemas, Line().objects)


def test_running_out_of_replies_is_an_error():
    with pytest.raises(BackendError) as caught:
        play(backend=ScriptedLLM([reply(go(1))]), budget=Budget(2))
    assert str(caught.value) == "the script has run out after 1 reply."


def test_an_error_in_the_prompt_passes_through():
    class Undescribed(Line):
        def describe(self, state):
            return (None,)

    with pytest.raises(PluginError):
        play(ARRIVE, env=Undescribed())


# ---- the same run again --------------------------------------------------------------------------------------------

REPLIES = st.one_of(
    st.lists(st.sampled_from([go(1), go(2), go(3), go(5), take("coin"), "dance()"]), max_size=3).map(
        lambda items: reply(*items)
    ),
    st.just(MUMBLE),
)


def run(script, seed):
    env, planner = Line({5: GOAL}, slippery={2.0: 0.5}), Detour(no_path={3: 1})
    return play(*script, env=env, planner=planner, seed=seed, clock=lambda: 0.0)


@given(st.lists(REPLIES, min_size=1, max_size=5), st.integers(0, 5))
@settings(max_examples=40)
def test_the_same_seed_and_the_same_replies_give_the_same_run(script, seed):
    assert run(script, seed) == run(script, seed)


@given(st.lists(REPLIES, min_size=1, max_size=5), st.integers(0, 5))
@settings(max_examples=40)
def test_counts_agree_with_the_attempts(script, seed):
    result = run([*script, ARRIVE], seed)
    outcomes = [outcome for attempt in result.attempts for outcome in attempt.outcomes]
    assert result.solved == result.goal.achieved
    assert result.stats.llm_calls == len(result.attempts)
    assert result.stats.reused_actions == sum(outcome.reused for outcome in outcomes)
    assert result.stats.unreadable_replies == sum(attempt.unreadable is not None for attempt in result.attempts)
    moved = [o for o in outcomes if not o.reused and str(o.action).startswith("go")]
    assert result.stats.motion_calls == len(moved)


def test_another_seed_gives_another_path():
    assert run([ARRIVE], 0).plan != run([ARRIVE], 1).plan


def test_every_request_has_a_seed_of_its_own_that_no_reply_changes():
    def seeds(seed, *script):
        model = ScriptedLLM(script)
        play(backend=model, budget=Budget(len(script)), seed=seed)
        return [request.seed for request in model.requests]

    first = seeds(0, reply(go(1)), reply(go(2)), MUMBLE)
    assert first == seeds(0, MUMBLE, reply(), reply(go(3)))
    assert len({*first, *seeds(1, MUMBLE, MUMBLE, MUMBLE)}) == 6


def test_any_backend_will_do():
    class Parrot(LLMBackend):
        def complete(self, request):
            return Completion(ARRIVE)

    parrot = Parrot()
    assert play(backend=parrot).solved
    assert parrot.is_language_model
    assert parrot.notice == ""
    parrot.close()
