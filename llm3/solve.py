"""The loop of the paper: reason and propose, roll out, feed back (Algorithm 1 of LLM3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf
from time import perf_counter

from llm3.budget import Budget
from llm3.errors import BackendError, PluginError, UsageError
from llm3.guarded import guarded
from llm3.interfaces import Env, FeedbackSynthesizer, LLMBackend, MotionPlanner, TrajectoryTimer
from llm3.parsing import parse_reply, reply_schema
from llm3.prompts import Prompt
from llm3.rollout import Roller, Tell
from llm3.seeding import derive_seed
from llm3.timing import timed
from llm3.trace import Trace
from llm3.types import (
    ActionTried,
    Attempt,
    AttemptEnded,
    CallFailed,
    Completion,
    Context,
    Entity,
    Failure,
    Feedback,
    GoalStatus,
    Observer,
    PlannedAction,
    PromptSent,
    ReplyRead,
    ReplyReceived,
    Request,
    Result,
    RunEnded,
    RunStarted,
    Sketch,
    State,
    Stats,
    Stop,
    nobody,
)


def solve(
    env: Env,
    *,
    backend: LLMBackend,
    planner: MotionPlanner,
    feedback: FeedbackSynthesizer,
    prompt: Prompt,
    timer: TrajectoryTimer | None = None,
    skeleton: tuple[Sketch, ...] = (),
    budget: Budget = Budget(),  # frozen, so one for all calls is fine
    seed: int = 0,
    observer: Observer = nobody,
    clock: Callable[[], float] = perf_counter,
) -> Result:
    """Ask the model for plans until one reaches the goal or the budget ends.

    Where the goal is reached at the start there is nothing to ask, and the plan is empty.

    Args:
        env: The problem.
        backend: The language model, or what stands in for it.
        planner: Finds the paths.
        feedback: Puts what failed into words.
        prompt: How the model is asked.
        timer: Puts times to the motions of the plan that is found, if the world knows the limits of all joints.
        skeleton: The given action sequence, where the strategy fixes it.
        budget: What the run may spend, and how much of the past a prompt tells.
        seed: All randomness derives from it: the same seed and the same replies give the same run.
        observer: Is told of everything as it happens.
        clock: Seconds, for the times by phase.

    Returns:
        The plan, if one was found, every attempt, and what was spent.

    Raises:
        LLM3Error: The program cannot go on, such as when no server answers. What the robot cannot do is no error.
    """
    if prompt.strategy.fixed_sequence and not skeleton:
        raise UsageError(
            f"the strategy's template {prompt.strategy.template!r} needs a skeleton: the given action sequence."
        )

    def goal_of(state: State) -> GoalStatus:
        return guarded(env.goal, (GoalStatus,), state)

    began = clock()
    start = guarded(env.reset, (State,))
    observer(RunStarted(start))
    roller = Roller(env, planner, seed, clock)
    schema = reply_schema(env.schemas, env.objects, skeleton)
    trace, stats = Trace(budget.trace_size), Stats()
    attempts: list[Attempt] = []
    goal = goal_of(start)
    plan: tuple[PlannedAction, ...] = ()
    stop: Stop | None = "solved" if goal.achieved else None
    while not stop:
        number = len(attempts) + 1
        context = context_of(env, start, trace.entries, skeleton)
        request = Request(
            prompt.render(context),
            context,
            derive_seed("request", seed, number),
            schema,
            inf if budget.max_seconds is None else budget.max_seconds - (clock() - began),
        )
        observer(PromptSent(number, request.messages))
        asked = clock()
        try:
            completion = guarded(backend.complete, (Completion,), request)
        except BackendError as error:
            spent = Stats(retries=error.retries, step_downs=error.step_downs, seconds={"model": clock() - asked})
            stats += spent
            observer(CallFailed(number, str(error), spent))
            stop = "seconds" if error.out_of_time else budget.used_up(stats, clock() - began)
            if stop:
                break
            raise
        stats += completion.stats + Stats(llm_calls=1, seconds={"model": clock() - asked})
        observer(ReplyReceived(number, completion))

        reading = parse_reply(completion.text, env.schemas, env.objects, skeleton, cut_off=completion.cut_off)
        observer(ReplyRead(number, reading))
        proposal, unreadable = (None, reading) if isinstance(reading, Failure) else (reading, None)
        rolled = roller.rollout(start, proposal.actions if proposal else (), teller(observer, number))
        goal, plan = goal_of(rolled.state), rolled.plan
        attempt = Attempt(number, goal, proposal, unreadable, rolled.outcomes)
        attempts.append(attempt)
        words = None if goal.achieved else guarded(feedback.synthesize, (Feedback, type(None)), attempt)
        trace = trace.add(attempt, words)
        stats += Stats(unreadable_replies=int(unreadable is not None))
        observer(AttemptEnded(attempt, words, stats + roller.stats))
        stop = "solved" if goal.achieved else budget.used_up(stats + roller.stats, clock() - began)
    solved = stop == "solved"
    result = Result(solved, plan if solved else (), goal, tuple(attempts), stats + roller.stats, start, stop)
    return ended(result, env, timer, observer, clock)


def ended(
    result: Result, env: Env, timer: TrajectoryTimer | None, observer: Observer, clock: Callable[[], float]
) -> Result:
    """The result with times for the motions of its plan, once the observer was told: how every run ends."""
    if result.solved and timer:
        began = clock()
        plan = timed(result.plan, timer, env.joints)
        result = replace(result, plan=plan, stats=result.stats + Stats(seconds={"timing": clock() - began}))
    observer(RunEnded(result))
    return result


def context_of(env: Env, start: State, trace: tuple[Feedback, ...] = (), skeleton: tuple[Sketch, ...] = ()) -> Context:
    """What a prompt is rendered from: the problem, its initial state, and what is told of earlier attempts."""
    entities = guarded(env.describe, (tuple, list), start)
    for name in env.objects:
        if not isinstance(name, str) or not name.strip() or not name.isprintable() or env.objects.count(name) > 1:
            raise PluginError(f"{type(env).__name__}.objects must be different names of one line, not {env.objects!r}.")
    for entity in entities:
        if not isinstance(entity, Entity):
            raise PluginError(f"{type(env).__name__}.describe must answer a tuple of Entity, not of {entity!r}.")
    return Context(env.task, env.schemas, env.objects, tuple(entities), trace, skeleton)


def teller(observer: Observer, attempt: int) -> Tell:
    """Tells the observer what becomes of the actions of an attempt."""
    return lambda index, before, outcome, step: observer(ActionTried(attempt, index, before, outcome, step))
