"""The view of a run on stderr: coloured and live in a terminal, plain lines in a pipe."""

from __future__ import annotations

from pathlib import Path
from types import TracebackType

from rich.status import Status
from rich.text import Text

from llm3.cli.console import ViewConsole
from llm3.cli.text import printable
from llm3.types import (
    ActionTried,
    AttemptEnded,
    CallFailed,
    Failure,
    Outcome,
    PromptSent,
    ReplyRead,
    Result,
    RunEvent,
)
from llm3.wording import ENDINGS, counted, failure_in_words


class RunView:
    """An observer that shows attempts, actions and outcomes. Use it in a ``with`` while the run goes on."""

    def __init__(self, quiet: bool, budget: int | None) -> None:
        """Start with nothing on the screen.

        Args:
            quiet: Show nothing at all.
            budget: The number of model calls that the run may make. None for a search: of its many attempts only the
                actions that are new are shown.
        """
        self._console = ViewConsole(quiet)
        self._budget = budget
        self._failed_call = ""
        self._status: Status | None = None
        if self._console.is_live:
            self._status = Status("", console=self._console)

    def __enter__(self) -> RunView:
        if self._status:
            self._status.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if self._status:
            self._status.stop()

    def note(self, text: str) -> None:
        """Show one line that is not part of the run."""
        self._line(text, "yellow")

    def __call__(self, event: RunEvent) -> None:
        """Show one event."""
        if isinstance(event, PromptSent):
            self._wait(f"attempt {event.attempt} of {self._budget}: asking for a plan")
        elif isinstance(event, CallFailed):
            self._failed_call = event.error
        elif isinstance(event, ReplyRead):
            if self._budget is None:
                self._wait(f"attempt {event.attempt}")
            elif isinstance(event.proposal, Failure):
                self._line(f"attempt {event.attempt} of {self._budget}: {event.proposal.detail}", "red")
            else:
                actions = counted(len(event.proposal.actions), "action")
                self._line(f"attempt {event.attempt} of {self._budget}: a plan of {actions}", "bold")
                self._wait(f"attempt {event.attempt} of {self._budget}: trying the plan")
        elif self._budget is None and (isinstance(event, AttemptEnded) or _known(event)):
            return
        elif isinstance(event, ActionTried):
            self._outcome(event.index + 1, event.outcome)
        elif isinstance(event, AttemptEnded) and event.attempt.failure is None and not event.attempt.goal.achieved:
            self._line(f"    goal not reached: {'; '.join(event.attempt.goal.unmet)}", "red")

    def summary(self, result: Result, seconds: float, folder: Path, cost: float | None = None) -> None:
        """Show how the run ended, what it took and, if known, what it cost, and where the record is."""
        stats = result.stats
        word, style = ("solved", "bold green") if result.solved else ("not solved", "bold red")
        asked = (
            counted(len(result.attempts), "plan") if self._budget is None else counted(stats.llm_calls, "model call")
        )
        self._line(
            f"{word} in {seconds:.1f} s: {asked}, "
            f"{counted(stats.motion_calls, 'motion call')}, {counted(stats.reused_actions, 'action')} reused",
            style,
        )
        if result.solved and not result.plan:
            self._line("the goal is reached before anything is done", "yellow")
        if stats.tokens:
            told = f"{stats.prompt_tokens:,} tokens read, {stats.completion_tokens:,} written"
            self._line(told if cost is None else f"{told}: {cost:.4g} by the price table")
        if result.stop in ENDINGS:
            self._line(ENDINGS[result.stop], "yellow")
        if self._failed_call:  # which ended the run by its time, and not as an error
            self._line(f"the last call got no answer: {self._failed_call}", "red")
        if result.time_limited:
            self._line("the time limit of a query was hit: another run may end differently", "yellow")
        self._line(f"record: {folder}")

    def _outcome(self, number: int, outcome: Outcome) -> None:
        failure = outcome.failure
        if failure is None:
            self._line(f"{number:>4}. {outcome.action}: feasible{' (known)' * outcome.reused}", "green")
        else:
            self._line(f"{number:>4}. {outcome.action}: {failure_in_words(failure)}", "red")
        for note in outcome.notes:
            self._line(f"      {note}", "yellow")

    def _line(self, text: str, style: str = "") -> None:
        self._console.tell(printable(text, keep_spaces=True), style)

    def _wait(self, text: str) -> None:
        if self._status:
            self._status.update(Text(text))


def _known(event: RunEvent) -> bool:
    return isinstance(event, ActionTried) and event.outcome.reused
