"""The loop of the paper: reason and propose, roll out, feed back (Algorithm 1 of LLM3)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter

from llm3.errors import UsageError
from llm3.interfaces import Env, FeedbackSynthesizer, LLMBackend, MotionPlanner
from llm3.parsing import parse_reply
from llm3.prompts import Prompt
from llm3.rollout import Roller
from llm3.seeding import derive_seed
from llm3.trace import Trace
from llm3.types import (
    ActionTried,
    Attempt,
    AttemptEnded,
    Context,
    Failure,
    Observer,
    Outcome,
    PlannedAction,
    PromptSent,
    ReplyRead,
    ReplyReceived,
    Request,
    Result,
    RunEnded,
    RunStarted,
    Sketch,
    Stats,
    nobody,
)


@dataclass(frozen=True)
class Budget:
    """What a run may spend."""

    max_llm_calls: int = 20
    """The paper's cap on model calls."""
    trace_size: int = 5
    """The paper's k: how many earlier attempts the model is told of."""

    def __post_init__(self) -> None:
        if self.max_llm_calls < 1:
            raise UsageError(f"the number of model calls must be at least 1, not {self.max_llm_calls}.")
        if self.trace_size < 0:
            raise UsageError(f"the trace size must be 0 or more, not {self.trace_size}.")


def solve(
    env: Env,
    *,
    backend: LLMBackend,
    planner: MotionPlanner,
    feedback: FeedbackSynthesizer,
    prompt: Prompt,
    skeleton: tuple[Sketch, ...] = (),
    budget: Budget = Budget(),  # frozen, so one for all calls is fine
    seed: int = 0,
    observer: Observer = nobody,
    clock: Callable[[], float] = perf_counter,
) -> Result:
    """Ask the model for plans until one reaches the goal or the budget ends.

    Args:
        env: The problem.
        backend: The language model, or what stands in for it.
        planner: Finds the paths.
        feedback: Puts what failed into words.
        prompt: How the model is asked.
        skeleton: The given action sequence, where the strategy fixes it.
        budget: How many model calls, and how much of the past a prompt tells.
        seed: All randomness derives from it: the same seed and the same replies give the same run.
        observer: Is told of everything as it happens.
        clock: Seconds, for the times by phase.

    Returns:
        The plan, if one was found, every attempt, and what was spent.

    Raises:
        LLM3Error: The program cannot go on, such as when no server answers. What the robot cannot do is no error.
    """
    start = env.reset()
    observer(RunStarted(start))
    roller = Roller(env, planner, seed, clock)
    trace, stats = Trace(budget.trace_size), Stats()
    attempts: list[Attempt] = []
    goal = env.goal(start)
    plan: tuple[PlannedAction, ...] = ()
    solved = False
    while not solved and len(attempts) < budget.max_llm_calls:
        number = len(attempts) + 1
        context = Context(env.task, env.schemas, env.objects, env.describe(start), trace.entries, skeleton=skeleton)
        request = Request(prompt.render(context), context, derive_seed("request", seed, number))
        observer(PromptSent(number, request.messages))
        began = clock()
        completion = backend.complete(request)
        stats += completion.stats + Stats(llm_calls=1, seconds={"model": clock() - began})
        observer(ReplyReceived(number, completion))

        proposal = parse_reply(completion.text, env.schemas, env.objects, skeleton)
        observer(ReplyRead(number, proposal))
        if isinstance(proposal, Failure):  # an attempt with no actions
            stats += Stats(unreadable_replies=1)
            rolled = roller.rollout(start, ())
            attempt = Attempt(number, env.goal(rolled.state), unreadable=proposal)
        else:
            rolled = roller.rollout(start, proposal.actions, _teller(observer, number))
            attempt = Attempt(number, env.goal(rolled.state), proposal, outcomes=rolled.outcomes)
        goal, plan = attempt.goal, rolled.plan
        solved = goal.achieved
        attempts.append(attempt)
        words = None if solved else feedback.synthesize(attempt)
        trace = trace.add(attempt, words)
        observer(AttemptEnded(attempt, words, stats + roller.stats))
    result = Result(solved, plan if solved else (), goal, tuple(attempts), stats + roller.stats, start)
    observer(RunEnded(result))
    return result


def _teller(observer: Observer, attempt: int) -> Callable[[int, Outcome], None]:
    return lambda index, outcome: observer(ActionTried(attempt, index, outcome))
